"""Records as the rows of a list, put into words where that keeps nobody waiting."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from tumble.app.headline import headline
from tumble.calibrations.core.quantities import format_in_unit
from tumble.calibrations.core.verdict import Model
from tumble.calibrations.records.record import Record
from tumble.window.look.moments import moment_text
from tumble.window.look.numbers import local
from tumble.window.look.sentences import in_language
from tumble.window.look.verdicts import verdict_words
from tumble.window.work.record_words import (
    Findings,
    StandState,
    findings_in,
    programme_text,
    stand_state,
    stand_words,
)


@dataclass(frozen=True, kw_only=True)
class RecordLine:
    """A record, and what the list says of it."""

    record: Record
    method: str
    """What its method measures, in words."""
    measured_at: datetime
    """When; of a record that does not say it, when it was made."""
    result: str
    """The parameter that stands for it."""
    findings: Findings
    stand: StandState
    stand_words: str

    @property
    def cells(self) -> tuple[str, ...]:
        """The texts of a row."""
        origin = self.record.provenance
        return (
            origin.serial_number,
            programme_text(self.record),
            moment_text(self.measured_at),
            verdict_words(self.record.verdict.outcome),
            self.result,
            str(self.findings.count),
            origin.stand_name,
            origin.lot,
            self.method,
            str(self.record.revision),
            self.record.id,
        )


def lines_of(records: Sequence[Record], titles: Mapping[str, str]) -> tuple[RecordLine, ...]:
    """The lines of records; `titles` says what the installed methods measure, by name."""
    return tuple(_line(record, titles.get(record.method, record.method)) for record in records)


def _line(record: Record, title: str) -> RecordLine:
    return RecordLine(
        record=record,
        method=in_language(title),
        measured_at=_measured_at(record),
        result=f"⚠ {_headline(record)}" if unsettled(record) else _headline(record),
        findings=findings_in(record),
        stand=stand_state(record),
        stand_words=in_language(stand_words(record)),
    )


def _measured_at(record: Record) -> datetime:
    written = record.provenance.measured_at
    moment = datetime.fromisoformat(written) if written else record.created_at
    return moment if moment.tzinfo else moment.replace(tzinfo=UTC)


def unsettled(record: Record) -> bool:
    """Whether a record has something to be read before its values: found, withheld, or cut off."""
    if record.model is Model.AUGMENTED or not record.complete:
        return True
    declared, values = record.parameters, record.values
    return any(each.value is not None and values[name].value is None for name, each in declared.items())


def _headline(record: Record) -> str:
    """The parameter that stands for the result, with the condition on which it stands; empty where none has a value."""
    parameter = headline(record)
    if parameter is None or parameter.value is None:
        return ""
    value = local(format_in_unit(parameter.value, parameter.standard_uncertainty, parameter.unit))
    condition = f" ({in_language(parameter.condition)})" if parameter.condition else ""
    return f"{parameter.name} = {value}{condition}"
