"""Runs that are to be measured one after the other, and what became of each."""

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields, replace
from enum import StrEnum
from pathlib import Path
from typing import Any, Final
from uuid import uuid4

from tumble.calibrations.core.verdict import Outcome


class Stage(StrEnum):
    """How far an entry of the queue is."""

    WAITING = "waiting"
    MOUNTING = "mounting"
    """The person at the stand is asked to do something."""
    MEASURING = "measuring"
    ANALYSING = "analysing"
    """The stand is free for the next one."""
    JUDGED = "judged"
    """There is a record."""
    FAILED = "failed"
    STOPPED = "stopped"


AT_STAND: Final = frozenset({Stage.MOUNTING, Stage.MEASURING})
UNDER_WAY: Final = AT_STAND | {Stage.ANALYSING}


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A run of a unit."""

    id: str = field(default_factory=lambda: uuid4().hex)
    """Of the entry, unlike that of any other that a window has ever made."""
    serial_number: str
    programme: str
    """Name of one that comes along, or path of its file."""
    lot: str = ""
    """Of the unit."""
    operator: str = ""
    stand: str = ""
    """Path of the stand file; empty for the stand that is built in."""
    repeat: int = 1
    repeats: int = 1
    """Which one of how many runs that were added together."""
    stage: Stage = Stage.WAITING
    owner: str = ""
    """Which window carries it out; empty where none does."""
    said: str = ""
    """Why it failed."""
    outcome: Outcome | None = None
    recording: str = ""
    """Path, once there is one."""
    record_id: str = ""

    def repeated(self, times: int) -> tuple["Entry", ...]:
        """So many runs of it, each an entry of its own."""
        return tuple(replace(self, id=uuid4().hex, repeat=repeat, repeats=times) for repeat in range(1, times + 1))

    def at(self, stage: Stage) -> "Entry":
        """The same, so far; where it is not under way, no window carries it out."""
        return replace(self, stage=stage, owner=self.owner if stage in UNDER_WAY else "")

    def begun(self, owner: str) -> "Entry":
        """The same at the stand of a window, for the first time or again."""
        return replace(self, stage=Stage.MEASURING, owner=owner, said="", outcome=None, record_id="")

    def recorded(self, path: Path) -> "Entry":
        """The same with its recording."""
        return replace(self, recording=str(path))

    def given_up(self) -> "Entry":
        """The same, waiting for any window again, unless something else became of it."""
        return self.at(Stage.WAITING) if self.stage in AT_STAND else self

    def failed(self, why: str) -> "Entry":
        """The same once it has failed."""
        return replace(self.at(Stage.FAILED), said=why)

    def judged(self, outcome: Outcome, record_id: str) -> "Entry":
        """The same with its record."""
        return replace(self.at(Stage.JUDGED), said="", outcome=outcome, record_id=record_id)

    def as_json(self) -> dict[str, Any]:
        """As it is kept."""
        return {name: value for name, value in vars(self).items() if value not in ("", None)}

    @classmethod
    def from_json(cls, kept: dict[str, Any]) -> "Entry":
        """An entry as it was kept; what a later version adds is passed over, and the first one had numbers for ids.

        Raises `KeyError`, `TypeError`, `ValueError`.
        """
        kept = kept if "id" in kept else kept | {"id": str(kept["number"])}
        outcome, known = kept.get("outcome"), {each.name: kept[each.name] for each in fields(cls) if each.name in kept}
        entry = cls(**known | {"stage": Stage(kept["stage"]), "outcome": Outcome(outcome) if outcome else None})
        texts = (
            entry.id,
            entry.serial_number,
            entry.programme,
            entry.lot,
            entry.operator,
            entry.stand,
            entry.recording,
            entry.record_id,
        )
        if not all(isinstance(text, str) for text in (*texts, entry.said, entry.owner)):
            raise TypeError(texts)
        if not all(isinstance(number, int) for number in (entry.repeat, entry.repeats)):
            raise TypeError(entry)
        return entry


class RunQueue:
    """Entries in the order in which they are measured; those that have begun stay where they are."""

    def __init__(self, entries: Iterable[Entry] = ()) -> None:
        self.entries = list(entries)

    def add(self, *entries: Entry) -> None:
        """Add runs at the end, those that are not there."""
        self.entries += [entry for entry in entries if self.get(entry.id) is None]

    def get(self, entry_id: str | None) -> Entry | None:
        """The entry of an id; None where it was removed, and of none."""
        return next((entry for entry in self.entries if entry.id == entry_id), None)

    def awaits_unit(self, entry_id: str, owner: str) -> bool:
        """Whether a window is still to begin an entry once its unit is there."""
        entry = self.get(entry_id)
        return entry is not None and entry.stage is Stage.MOUNTING and entry.owner == owner

    def change(self, entry_id: str, change: Callable[[Entry], Entry]) -> None:
        """Put what becomes of an entry in its place, unless it was removed meanwhile."""
        self.entries = [change(entry) if entry.id == entry_id else entry for entry in self.entries]

    @property
    def waiting(self) -> int:
        """How many wait."""
        return sum(entry.stage is Stage.WAITING for entry in self.entries)

    @property
    def twice(self) -> tuple[str, ...]:
        """Units that wait more than once for one run: each was added anew, and not as often as it was wanted."""
        runs = Counter(
            (entry.serial_number, entry.programme, entry.stand, entry.repeat)
            for entry in self.entries
            if entry.stage is Stage.WAITING
        )
        return tuple(dict.fromkeys(serial_number for (serial_number, *_), count in runs.items() if count > 1))

    def claim(self, owner: str, stand: str) -> Entry | None:
        """Give a window the entry that waits longest for its stand; returns it, None where none waits for that."""
        waiting = (each for each in self.entries if each.stage is Stage.WAITING and each.stand == stand)
        entry = next(waiting, None)
        if entry is not None:
            self.change(entry.id, lambda each: each.begun(owner))
        return entry

    def settle(self, is_open: Callable[[str], bool]) -> None:
        """Have what was under way in a window that is open no more be stopped."""
        self.entries = [
            entry if entry.stage not in UNDER_WAY or is_open(entry.owner) else entry.at(Stage.STOPPED)
            for entry in self.entries
        ]

    def of_recording(self, path: str) -> Entry | None:
        """The entry that a recording belongs to."""
        return next((entry for entry in self.entries if entry.recording == path), None)

    def move(self, entry_id: str, places: int) -> None:
        """Move an entry that waits up or down among those that wait."""
        waiting = [place for place, entry in enumerate(self.entries) if entry.stage is Stage.WAITING]
        here = next((rank for rank, place in enumerate(waiting) if self.entries[place].id == entry_id), None)
        if here is None or not 0 <= here + places < len(waiting):
            return
        one, other = waiting[here], waiting[here + places]
        self.entries[one], self.entries[other] = self.entries[other], self.entries[one]

    def remove(self, entry_id: str) -> None:
        """Take an entry out that is not under way."""
        self._keep(lambda entry: entry.id != entry_id)

    def clear(self) -> None:
        """Take out everything that is not under way."""
        self._keep(lambda _: False)

    def _keep(self, wanted: Callable[[Entry], bool]) -> None:
        self.entries = [entry for entry in self.entries if wanted(entry) or entry.stage in UNDER_WAY]
