"""Whether a record can be believed: file and record untouched, and the numbers come back."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tumble.calibrations.core.verdict import Model
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.export import document, is_intact
from tumble.calibrations.records.parameter import RecordedParameter, parameters_from_json
from tumble.calibrations.records.raw import file_sha256
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.rows import parameter_rows, record_row
from tumble.messages import Message

if TYPE_CHECKING:
    from tumble.calibrations.records.store import Store

TOLERANCE = 1e-6
"""By how much of its standard uncertainty a number may differ from the one recorded.

The same data give the same bits on one machine; another processor or linear algebra library rounds differently.
Changing the last bit of every voltage moved parameters by up to 1e-8 of their uncertainty: a millionth is a hundred
times that, and a change of data or method moves them by far more.
"""

Refit = Callable[[Sequence[Path], Mapping[str, Any]], Entry]
"""From the raw files and the stand file as data to the result that would be recorded."""


class RawFile(StrEnum):
    """What became of the raw file."""

    INTACT = "intact"
    CHANGED = "changed"
    MISSING = "missing"


@dataclass(frozen=True, kw_only=True)
class SourceCheck:
    """One raw file of a record and what became of it."""

    path: Path
    state: RawFile


@dataclass(frozen=True, kw_only=True)
class ParameterCheck:
    """One parameter as recorded and as fitted again; None where one of the two does not have it."""

    model: str
    """`declared` or `augmented`."""
    name: str
    recorded: RecordedParameter | None
    refitted: RecordedParameter | None
    agrees: bool
    """Value, uncertainty and interval to within `TOLERANCE`, the conditions exactly."""

    @property
    def words(self) -> str:
        """What to call it in a sentence."""
        if self.model == Model.DECLARED:
            return self.name
        return Message("{name} of the augmented model", name=self.name)


@dataclass(frozen=True, kw_only=True)
class Verification:
    """What was found; `verified` sums it up."""

    record_id: str
    sources: tuple[SourceCheck, ...]
    """The raw files."""
    altered: tuple[str, ...]
    """What the store holds differently from what was recorded: `content`, `column operator`, `parameters`."""
    parameters: tuple[ParameterCheck, ...]
    """Empty where a raw file is not intact: then nothing is fitted."""
    unknown: str
    """The method, where this program cannot carry it out and nothing was fitted; else empty."""
    recorded_with: str
    """Version of the program that made the record."""
    verified_with: str
    """Version of the program that verified it."""

    @property
    def intact(self) -> bool:
        """Whether every raw file is there and unchanged."""
        return all(source.state is RawFile.INTACT for source in self.sources)

    @property
    def verified(self) -> bool:
        """Raw files and record intact, every number back."""
        return self.intact and not self.altered and not self.unknown and all(check.agrees for check in self.parameters)

    @property
    def sentences(self) -> tuple[str, ...]:
        """The findings in words."""
        return (*map(_source_sentence, self.sources), self._record_sentence, self._refit_sentence, *self._remarks())

    @property
    def _record_sentence(self) -> Message:
        if not self.altered:
            return Message("The record is intact.")
        return Message("Altered in the store: {parts}.", parts=Message.joined(", ", self.altered))

    @property
    def _refit_sentence(self) -> Message:
        different = [check.words for check in self.parameters if not check.agrees]
        if different:
            return Message(
                "Fitted again, these do not come back: {parameters}.", parameters=Message.joined(", ", different)
            )
        if not self.parameters:
            return Message("Nothing was fitted again.")
        return Message(
            "Fitted again, every parameter comes back to {tolerance:g} of its standard uncertainty.",
            tolerance=TOLERANCE,
        )

    def _remarks(self) -> Iterator[Message]:
        if self.unknown:
            yield Message("This program cannot carry out the method {method}; update it.", method=self.unknown)
        if self.recorded_with != self.verified_with:
            yield Message(
                "Recorded with version {recorded}, verified with {verified}.",
                recorded=self.recorded_with,
                verified=self.verified_with,
            )


def _source_sentence(source: SourceCheck) -> Message:
    return Message("Raw file {path}: {state}.", path=source.path, state=_STATES[source.state])


_STATES: Final = {
    RawFile.INTACT: Message("intact"),
    RawFile.CHANGED: Message("changed"),
    RawFile.MISSING: Message("missing"),
}


def verify(record: Record, store: "Store", refit: Refit | None, program_version: str) -> Verification:
    """Hash the raw files and the record again, and fit again from the raw files.

    Parameters
    ----------
    record
        A record of `store`.
    refit
        Reads the raw files and analyses them; its errors are passed on. None where the method is not known.
    program_version
        Version of the program that verifies.
    """
    sources = tuple(
        SourceCheck(path=path, state=_state(path, source.sha256))
        for path, source in zip(store.raw_files(record), record.provenance.sources, strict=True)
    )
    intact = all(source.state is RawFile.INTACT for source in sources)
    again = refit([source.path for source in sources], record.provenance.stand) if refit and intact else None
    return Verification(
        record_id=record.id,
        sources=sources,
        altered=altered(record, store),
        parameters=_checks(record, again) if again else (),
        unknown="" if refit else record.method,
        recorded_with=record.provenance.program_version,
        verified_with=program_version,
    )


def _state(path: Path, sha256: str) -> RawFile:
    if not path.is_file():
        return RawFile.MISSING
    return RawFile.INTACT if file_sha256(path) == sha256 else RawFile.CHANGED


def altered(record: Record, store: "Store") -> tuple[str, ...]:
    """What the store holds differently from what was recorded, see `Verification.altered`."""
    row, parameters = store.rows(record)
    columns = [Message("column {name}", name=name) for name, value in record_row(record).items() if row[name] != value]
    return (
        *(() if is_intact(document(record)) else (Message("content"),)),
        *columns,
        *(() if _by_name(parameters) == _by_name(parameter_rows(record)) else (Message("parameters"),)),
    )


def _by_name(rows: list[dict[str, Any]]) -> dict[tuple[str, str], dict[str, Any]]:
    return {(row["model"], row["name"]): row for row in rows}


def _checks(record: Record, again: Entry) -> tuple[ParameterCheck, ...]:
    """Every parameter of the models in the record; a record of format 1 has the declared model alone."""
    refitted = {model: parameters_from_json(listed) for model, listed in again.models.items()}
    return tuple(
        _check(model, name, recorded.get(name), refitted.get(model, {}).get(name))
        for model, recorded in record.models.items()
        for name in {**recorded, **refitted.get(model, {})}
    )


def _check(
    model: str, name: str, recorded: RecordedParameter | None, refitted: RecordedParameter | None
) -> ParameterCheck:
    agrees = recorded is not None and refitted is not None and _agree(recorded, refitted)
    return ParameterCheck(model=model, name=name, recorded=recorded, refitted=refitted, agrees=agrees)


def _agree(a: RecordedParameter, b: RecordedParameter) -> bool:
    if (a.unit, a.given) != (b.unit, b.given):
        return False
    allowed = TOLERANCE * (a.standard_uncertainty or 0.0)
    pairs = zip(_numbers(a), _numbers(b), strict=True)
    return all(x == y if x is None or y is None else abs(x - y) <= allowed for x, y in pairs)


def _numbers(parameter: RecordedParameter) -> tuple[float | None, ...]:
    return (parameter.value, parameter.standard_uncertainty, *(parameter.interval_95 or (None, None)))
