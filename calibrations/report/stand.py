"""The section on the stand record that was applied: what was corrected, how well it is known, what contradicts it."""

from typing import Any

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.report.drawing import BAND, COLOURS, WIDE_IN, sheet, styled, to_svg
from tumble.calibrations.report.subject import Subject
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.calibrations.stand_records.record import StandRecord

_ARCSEC = 3600.0


def corrections_of_the_stand(subject: Subject) -> dict[str, Any]:
    """The record with its terms, each as the units say it, and the head map."""
    record = subject.calibration.stand_record
    if record is None:
        return {"record": None}
    head_map = record.corrections.head_map
    return {
        "record": record,
        "units": series(record.units),
        "agreement": "" if record.agreement_p is None else equals(record.agreement_p),
        "terms": [record.corrections.text(term) for term in record.corrections.terms],
        "contradictions": subject.contradictions,
        "validity": _validity(record),
        "figure": head_map_figure(head_map) if head_map else None,
    }


def _validity(record: StandRecord) -> str:
    known = record.validity
    ranges = [(known.angle_deg, "°"), (known.voltage_v, " V"), (known.temperature_degc, " °C")]
    texts = [f"{pair[0]:.4g} to {pair[1]:.4g}{unit}" for pair, unit in ranges if pair]
    dates = {known.measured_from, known.measured_to} - {""}
    return ", ".join([*texts, *([f"measured {' to '.join(sorted(dates))}"] if dates else [])])


@styled
def head_map_figure(head_map: HeadMap) -> Markup:
    """True minus reported angle over a turn, after moves in each direction where that differs, with two u."""
    figure, (panel,) = sheet(WIDE_IN, 2.9)
    directions = (
        {1: "after moves in + direction", -1: "after moves in - direction"} if head_map.backlash_deg else {1: ""}
    )
    for colour, (direction, label) in enumerate(directions.items()):
        curve = head_map.curve(direction)
        error, twice = curve.error_deg * _ARCSEC, 2 * curve.standard_uncertainty_deg * _ARCSEC
        panel.fill_between(curve.angle_deg, error - twice, error + twice, color=BAND, alpha=0.35, linewidth=0)
        panel.plot(curve.angle_deg, error, color=COLOURS[colour], linewidth=1.3, label=label or None)
    panel.axhline(0.0, color=COLOURS[-1], linewidth=0.5)
    panel.set_xticks(np.arange(0, 361, 45))
    panel.set_xlabel("head angle as reported (°)")
    panel.set_ylabel("true - reported (″)")
    if len(directions) > 1:
        panel.legend(loc="upper right", ncols=2)
    return to_svg(figure, "head-map", "Error of the head over a turn with its uncertainty")
