"""What a list says of a record beside its values: effects, and the stand."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from tumble.calibrations.records.findings import UNNAMED, effects_of, is_unexplained, words_of
from tumble.calibrations.records.record import Record
from tumble.drivers.driver import SIMULATED
from tumble.messages import Message, with_wording


class StandState(StrEnum):
    """What is known of the stand of a record."""

    CORRECTED = "corrected"
    """Its stand record was applied."""
    UNCORRECTED = "uncorrected"
    SIMULATED = "simulated"


@dataclass(frozen=True, kw_only=True)
class Findings:
    """What the loop found in a record."""

    effects: tuple[str, ...]
    """What they are called."""
    unnamed: bool
    """Whether there is structure without a name."""

    @property
    def count(self) -> int:
        """How many there are, structure without a name among them."""
        return len(self.effects) + self.unnamed

    @property
    def lines(self) -> tuple[str, ...]:
        """The same in words."""
        if not self.count:
            return (Message("no effect was found"),)
        return (*self.effects, *([words_of(UNNAMED)] if self.unnamed else []))


def findings_in(record: Record) -> Findings:
    """Effects and structure without a name."""
    names = dict.fromkeys(str(each["name"]) for each in effects_of(record))
    return Findings(effects=tuple(map(with_wording, names)), unnamed=is_unexplained(record))


def stand_state(record: Record) -> StandState:
    """What is known of the stand on which a record was measured."""
    if record.result.get("stand_record") is not None:
        return StandState.CORRECTED
    return StandState.SIMULATED if set(_drivers(record)) == {SIMULATED} else StandState.UNCORRECTED


def stand_words(record: Record) -> str:
    """The stand of a record, and what is known of it; empty where the record names none."""
    name = record.provenance.stand_name
    if not name:
        return ""
    match stand_state(record):
        case StandState.CORRECTED:
            version = record.result["stand_record"]["version"]
            return Message("{stand}, corrected by version {version} of its stand record", stand=name, version=version)
        case StandState.SIMULATED:
            return Message("{stand}: a simulated stand", stand=name)
        case StandState.UNCORRECTED:
            return Message("{stand}, not corrected by a stand record", stand=name)


def _drivers(record: Record) -> Iterator[str]:
    """The drivers of a stand's instruments, in tables of their own or by name in those of their kind."""
    for table in record.provenance.stand.values():
        if isinstance(table, dict):
            yield from (str(each["driver"]) for each in (table, *table.values()) if _names_a_driver(each))


def _names_a_driver(table: object) -> bool:
    return isinstance(table, dict) and "driver" in table


def programme_text(record: Record) -> str:
    """The programme of a record, and how many files beside that of the first run are taken together with it."""
    origin = record.provenance
    return f"{origin.programme_name} + {further}" if (further := len(origin.sources) - 1) > 0 else origin.programme_name
