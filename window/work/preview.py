"""A record in short, put into words where that keeps nobody waiting."""

from collections.abc import Sequence
from dataclasses import dataclass

from tumble.calibrations.core.quantities import format_concise, format_expanded
from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.messages import Message
from tumble.window.look.moments import written_moment_text
from tumble.window.look.sentences import in_language, lot_text
from tumble.window.look.verdicts import verdict_words
from tumble.window.work.record_words import findings_in, programme_text, stand_words


@dataclass(frozen=True, kw_only=True)
class Preview:
    """What there is to read of a record before it is opened, in the language of the window."""

    unit: str
    subject: str
    """Lot, programme, moment, operator."""
    outcome: Outcome
    values: Sequence[tuple[str, str, str]]
    """The values to use: name, value with its expanded uncertainty, verdict and condition."""
    findings: Sequence[str]
    stand: str
    warnings: str
    """How many there are; empty where there are none."""


def preview(record: Record) -> Preview:
    """Put a record into words."""
    origin = record.provenance
    subject = (lot_text(origin.lot), programme_text(record), written_moment_text(origin.measured_at), origin.operator)
    return Preview(
        unit=origin.serial_number,
        subject=" · ".join(filter(None, subject)),
        outcome=record.verdict.outcome,
        values=[_value(record, each) for each in record.values.values()],
        findings=tuple(map(in_language, findings_in(record).lines)),
        stand=in_language(stand_words(record)),
        warnings=_counted(len(record.result.get("warnings", ()))),
    )


def _value(record: Record, parameter: RecordedParameter) -> tuple[str, str, str]:
    judged = record.verdict.of(parameter.name)
    beside = (verdict_words(judged.outcome) if judged else "", in_language(parameter.condition))
    text = value_text(parameter) or Message("not identifiable")
    return parameter.name, in_language(text), "; ".join(filter(None, beside))


def _counted(warnings: int) -> str:
    """A record keeps them in English, as they were written; they are read where it is opened."""
    if not warnings:
        return ""
    return in_language(
        Message.counted(
            "{count} warning: open the record to read it",
            "{count} warnings: open the record to read them",
            count=warnings,
        )
    )


def value_text(parameter: RecordedParameter) -> str:
    """The value with its expanded uncertainty, or the standard one where there is no interval; empty without value."""
    if parameter.value is None:
        return ""
    if parameter.interval_95 is None:
        return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
    return format_expanded(parameter.value, parameter.interval_95, parameter.unit)
