"""The section on the stand record that was applied: what was corrected, how well it is known, what contradicts it."""

from collections.abc import Iterator, Sequence
from typing import Final

from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.report.maps import head_map_figure
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message


def stand_sections(subject: Subject) -> Iterator[Section]:
    """The record with its terms, each as the units say it, and the head map."""
    record = subject.calibration.stand_record
    if record is None:
        yield Section(title="", lines=[Message("No stand record was applied.")])
        return
    yield Section(
        title="",
        lines=[
            Message("{applied} What it does not know is a line of the budget.", applied=_applied(record)),
            *(Message("{contradiction}.", contradiction=each) for each in subject.contradictions),
            *(record.corrections.text(term) for term in record.corrections.terms),
            Message(
                "Known for {validity}. Identifier {identifier}, SHA-256 {content_sha256}.",
                validity=_validity(record),
                identifier=record.id,
                content_sha256=record.content_sha256,
            ),
        ],
    )
    if head_map := record.corrections.head_map:
        yield Section(
            title="",
            figure=lambda: head_map_figure(head_map),
            caption=Message(
                "What the head map adds to the reported angle. The band is twice its standard uncertainty. A mean "
                "error is no part of it: that is alpha0's."
            ),
        )


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
