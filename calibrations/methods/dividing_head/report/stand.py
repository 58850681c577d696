"""The section on the stand record that was applied: what was corrected, how well it is known, what contradicts it."""

from collections.abc import Iterator, Sequence
from typing import Any, Final

from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.report.maps import head_map_figure
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message


def corrections_of_the_stand(subject: Subject) -> dict[str, Any]:
    """The record with its terms, each as the units say it, and the head map."""
    record = subject.calibration.stand_record
    if record is None:
        return {"record": None}
    head_map = record.corrections.head_map
    return {
        "record": record,
        "applied": _applied(record),
        "terms": [record.corrections.text(term) for term in record.corrections.terms],
        "contradictions": subject.contradictions,
        "validity": _validity(record),
        "figure": head_map_figure(head_map) if head_map else None,
    }


def _applied(record: StandRecord) -> Message:
    """Which record corrected the rows, and on what it rests."""
    said = Message(
        "Angles and voltages were corrected by stand record {version} of {stand} (head {head}, DAQ {daq}), which rests "
        "on {units}",
        version=record.version,
        stand=record.identity.stand,
        head=record.identity.head or _UNNAMED,
        daq=record.identity.daq or _UNNAMED,
        units=series(record.units),
    )
    if record.agreement_p is None:
        return Message("{said}.", said=said)
    return Message("{said}; the units agree (p {p_value}).", said=said, p_value=equals(record.agreement_p))


_UNNAMED: Final = Message("unnamed")


def _validity(record: StandRecord) -> str:
    known = record.validity
    ranges = [(known.angle_deg, "°"), (known.voltage_v, " V"), (known.temperature_degc, " °C")]
    texts = [
        Message("{lowest:.4g} to {highest:.4g}{unit}", lowest=pair[0], highest=pair[1], unit=unit)
        for pair, unit in ranges
        if pair
    ]
    return Message.joined(", ", [*texts, *_measured(sorted({known.measured_from, known.measured_to} - {""}))])


def _measured(dates: Sequence[str]) -> Iterator[Message]:
    match dates:
        case [only]:
            yield Message("measured {date}", date=only)
        case [first, last]:
            yield Message("measured {first} to {last}", first=first, last=last)
