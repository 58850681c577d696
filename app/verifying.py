"""A store held against its folder: every record verified, and what has no record named."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.app.exits import JobError
from tumble.app.files import RECORDING_SUFFIX
from tumble.app.recall import unprotected, verify_record
from tumble.app.resuming import is_set_aside
from tumble.calibrations.records.chain import Chain
from tumble.calibrations.records.errors import RecordError, StoreError
from tumble.calibrations.records.inventory import Inventory
from tumble.calibrations.records.raw import resolved_path
from tumble.calibrations.records.verify import altered
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.errors import RecordingError

if TYPE_CHECKING:
    from tumble.calibrations.records.record import Record
    from tumble.calibrations.records.store import Store

_ID = re.compile(r"\d{8}-\d{6}-[0-9a-f]{6}")


class Judgement(StrEnum):
    """What is said of a thing in a word or two; in capitals where something is wrong."""

    VERIFIED = "verified"
    WHOLE = "whole"
    """A chain of records."""
    UNRECORDED = "no record"
    """A recording that needs none."""
    NOT_VERIFIED = "NOT VERIFIED"
    RECORD_LOST = "NO RECORD"
    """A recording or a report of which there must have been one."""
    REMOVED = "REMOVED"
    BROKEN = "BROKEN"
    """A chain from which a record was taken, or in which one was altered."""
    RECORDS_REMOVED = "RECORDS REMOVED"
    DAMAGED = "DAMAGED"

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return _WORDS[self]


_WORDS: Final = {
    Judgement.VERIFIED: Message("verified"),
    Judgement.WHOLE: Message("whole"),
    Judgement.UNRECORDED: Message("no record"),
    Judgement.NOT_VERIFIED: Message("NOT VERIFIED"),
    Judgement.RECORD_LOST: Message("NO RECORD"),
    Judgement.REMOVED: Message("REMOVED"),
    Judgement.BROKEN: Message("BROKEN"),
    Judgement.RECORDS_REMOVED: Message("RECORDS REMOVED"),
    Judgement.DAMAGED: Message("DAMAGED"),
}


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What verifying found of one thing: a record, a file, or the database."""

    name: str
    judgement: Judgement
    sentences: tuple[str, ...]

    @property
    def good(self) -> bool:
        """Whether nothing is wrong."""
        return self.judgement in (Judgement.VERIFIED, Judgement.WHOLE, Judgement.UNRECORDED)


def verified_record(store: "Store", record_id: str) -> Finding:
    """Verify one record; what keeps that from being done is a finding like another."""
    return _looked_at(store, record_id, _verified)


def _looked_at(store: "Store", record_id: str, look: "Callable[[Store, Record], Finding]") -> Finding:
    try:
        return look(store, store.get(record_id))
    except (StoreError, RecordError, InputError, JobError) as error:
        why = Message("{error}.", error=error)
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError) as error:  # whatever was put into its JSON
        why = Message(
            "The record is damaged ({kind}: {error}); restore {path} from a backup.",
            kind=type(error).__name__,
            error=error,
            path=store.path,
        )
    return Finding(name=record_id, judgement=Judgement.NOT_VERIFIED, sentences=(why,))


def _verified(store: "Store", record: "Record") -> Finding:
    found, old = verify_record(store, record), unprotected(store.raw_files(record))
    judgement = Judgement.VERIFIED if found.verified else Judgement.NOT_VERIFIED
    return Finding(name=record.id, judgement=judgement, sentences=(*found.sentences, *([old] if old else [])))


def leftovers(store: "Store") -> tuple[Finding, ...]:
    """What in a store's folder and tables belongs to no record, and what SQLite finds wrong with the file.

    A run that was to be calibrated has a record once it is complete; one that was only measured (`tumble run`, an
    experiment of a loop) may have none, and is named without a doubt of it.
    """
    inventory = store.inventory()
    return (
        *(_fault(store.path, fault) for fault in inventory.faults),
        *(_removed(record_id) for record_id in inventory.removed),
        *_superseded(store, inventory),
        *(_chain(chain) for chain in inventory.chains),
        *_gaps(store.path, inventory),
        *_reports(store.folder, inventory),
        *_recordings(store.folder, inventory),
    )


def _fault(path: Path, fault: str) -> Finding:
    damaged = Message("The database is damaged ({fault}); restore it from a backup.", fault=fault)
    return Finding(name=str(path), judgement=Judgement.DAMAGED, sentences=(damaged,))


def _removed(record_id: str) -> Finding:
    lost = Message(
        "It is not in the store, although other rows name it: it was removed; restore the store from a backup."
    )
    return Finding(name=record_id, judgement=Judgement.REMOVED, sentences=(lost,))


def _superseded(store: "Store", inventory: Inventory) -> Iterator[Finding]:
    """Superseded records that were altered; they are not fitted again."""
    for record_id in sorted(inventory.ids - set(store.standing())):
        found = _looked_at(store, record_id, _unaltered)
        if not found.good:
            yield found


def _unaltered(store: "Store", record: "Record") -> Finding:
    parts = altered(record, store)
    if not parts:
        return Finding(name=record.id, judgement=Judgement.VERIFIED, sentences=())
    words = Message("Altered in the store: {listed}; restore the store from a backup.", listed=", ".join(parts))
    return Finding(name=record.id, judgement=Judgement.NOT_VERIFIED, sentences=(words,))


def _chain(chain: Chain) -> Finding:
    """The last hash is said so that it can be noted elsewhere: against it a store made anew is held."""
    name = Message("chain {writer}", writer=chain.writer)
    if chain.place:
        name = Message("chain {writer} of {place}", writer=chain.writer, place=chain.place)
    if not chain.faults:
        last = Message(
            "Every record follows from the one before; the last, number {length}, is {last_sha256}.",
            length=chain.length,
            last_sha256=chain.last_sha256[:16],
        )
        return Finding(name=name, judgement=Judgement.WHOLE, sentences=(last,))
    broken = tuple(Message("{fault}; restore the store from a backup.", fault=fault) for fault in chain.faults)
    return Finding(name=name, judgement=Judgement.BROKEN, sentences=broken)


def _gaps(path: Path, inventory: Inventory) -> Iterator[Finding]:
    if lost := inventory.numbers_without_record:
        words = Message.counted(
            "A record was deleted from the database; restore it from a backup.",
            "{count} records were deleted from the database; restore it from a backup.",
            count=lost,
        )
        yield Finding(name=str(path), judgement=Judgement.RECORDS_REMOVED, sentences=(words,))


def _reports(folder: Path, inventory: Inventory) -> Iterator[Finding]:
    for path in sorted((folder / "reports").glob("*.html")):
        if _ID.fullmatch(path.stem) and path.stem not in inventory.ids:
            lost = Message("This report has no record: that was removed from the store; restore it from a backup.")
            yield Finding(name=str(path), judgement=Judgement.RECORD_LOST, sentences=(lost,))


def _recordings(folder: Path, inventory: Inventory) -> Iterator[Finding]:
    recorded = {resolved_path(folder, path).resolve() for path in inventory.raw_paths}
    for path in sorted((folder / "recordings").rglob(f"*{RECORDING_SUFFIX}")):
        if path.resolve() not in recorded and not is_set_aside(path):
            yield _without_record(path)


def _without_record(path: Path) -> Finding:
    from tumble.procedures.recording.reader import read_recording  # MCAP only where there is a recording

    try:
        recording = read_recording(path)
    except RecordingError as error:
        judgement = Judgement.RECORD_LOST
        words: str = Message("It has no record, and cannot be read: {error}.", error=error)
    else:
        judgement, words = _why_without(recording.header.job, recording.complete)
    return Finding(name=str(path), judgement=judgement, sentences=(words,))


def _why_without(job: str, complete: bool) -> tuple[Judgement, Message]:
    """What it means that a recording has no record."""
    if job != "calibrate":
        return (
            Judgement.UNRECORDED,
            Message("It has no record: it was measured and never calibrated, or its record was removed."),
        )
    if not complete:
        return Judgement.UNRECORDED, Message(
            "It has no record: the run did not come to its end; tumble resume goes on with it."
        )
    return (
        Judgement.RECORD_LOST,
        Message("It has no record: that was removed from the store, or never came; tumble resume makes it anew."),
    )
