"""Error of a head over a turn, drawn."""

import numpy as np
from markupsafe import Markup

from tumble.calibrations.report.drawing import BAND, COLOURS, WIDE_IN, sheet, styled, to_svg
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.messages import Message

_ARCSEC = 3600.0


@styled
def head_map_figure(head_map: HeadMap) -> Markup:
    """True minus reported angle over a turn, after moves in each direction where that differs, with two u."""
    figure, (panel,) = sheet(WIDE_IN, 2.9)
    directions = (
        {1: Message("after moves in + direction"), -1: Message("after moves in - direction")}
        if head_map.backlash_deg
        else {1: ""}
    )
    for colour, (direction, label) in enumerate(directions.items()):
        curve = head_map.curve(direction)
        error, twice = curve.error_deg * _ARCSEC, 2 * curve.standard_uncertainty_deg * _ARCSEC
        panel.fill_between(curve.angle_deg, error - twice, error + twice, color=BAND, alpha=0.35, linewidth=0)
        panel.plot(curve.angle_deg, error, color=COLOURS[colour], linewidth=1.3, label=label or None)
    panel.axhline(0.0, color=COLOURS[-1], linewidth=0.5)
    panel.set_xticks(np.arange(0, 361, 45))
    panel.set_xlabel(Message("head angle as reported (°)"))
    panel.set_ylabel(Message("true - reported (″)"))
    if len(directions) > 1:
        panel.legend(loc="upper right", ncols=2)
    return to_svg(figure, "head-map", Message("Error of the head over a turn with its uncertainty"))
