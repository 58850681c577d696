"""A store held against its folder: every record verified, and what has no record named."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from app.exits import JobError
from app.files import RECORDING_SUFFIX
from app.recall import unprotected, verify_record
from app.resuming import is_set_aside
from calibrations.records.errors import RecordError, StoreError
from calibrations.records.inventory import Inventory
from calibrations.records.raw import resolved_path
from calibrations.records.store import Store
from procedures.errors import InputError

_ID = re.compile(r"\d{8}-\d{6}-[0-9a-f]{6}")


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What verifying found of one thing: a record, a file, or the database."""

    name: str
    verified: bool
    sentences: tuple[str, ...]


def verified_record(store: Store, record_id: str) -> Finding:
    """Verify one record; what keeps that from being done is a finding like another."""
    try:
        record = store.get(record_id)
        found = verify_record(store, record)
    except (StoreError, RecordError, InputError, JobError) as error:
        return Finding(name=record_id, verified=False, sentences=(f"{error}.",))
    except (AttributeError, KeyError, TypeError, ValueError) as error:  # whatever was put into its JSON
        damaged = f"The record is damaged ({type(error).__name__}: {error}); restore {store.path} from a backup."
        return Finding(name=record_id, verified=False, sentences=(damaged,))
    old = unprotected(store.raw_file(record))
    return Finding(name=record.id, verified=found.verified, sentences=(*found.sentences, *([old] if old else [])))


def leftovers(store: Store) -> tuple[Finding, ...]:
    """What in a store's folder and tables belongs to no record, and what SQLite finds wrong with the file.

    A run that was to be calibrated has a record once it is complete; one that was only measured (`tumble run`, an
    experiment of a loop) may have none, and is named without a doubt of it.
    """
    inventory = store.inventory()
    return (
        *(_fault(store.path, fault) for fault in inventory.faults),
        *(_removed(record_id) for record_id in inventory.removed),
        *_gaps(store.path, inventory),
        *_reports(store.folder, inventory),
        *_recordings(store.folder, inventory),
    )


def _fault(path: Path, fault: str) -> Finding:
    return Finding(
        name=str(path), verified=False, sentences=(f"The database is damaged ({fault}); restore it from a backup.",)
    )


def _removed(record_id: str) -> Finding:
    lost = "It is not in the store, although other rows name it: it was removed; restore the store from a backup."
    return Finding(name=record_id, verified=False, sentences=(lost,))


def _gaps(path: Path, inventory: Inventory) -> Iterator[Finding]:
    if lost := inventory.numbers_without_record:
        records = "A record was" if lost == 1 else f"{lost} records were"
        words = f"{records} deleted from the database; restore it from a backup."
        yield Finding(name=str(path), verified=False, sentences=(words,))


def _reports(folder: Path, inventory: Inventory) -> Iterator[Finding]:
    for path in sorted((folder / "reports").glob("*.html")):
        if _ID.fullmatch(path.stem) and path.stem not in inventory.ids:
            lost = "This report has no record: that was removed from the store; restore it from a backup."
            yield Finding(name=str(path), verified=False, sentences=(lost,))


def _recordings(folder: Path, inventory: Inventory) -> Iterator[Finding]:
    recorded = {
        resolved_path(folder, part).resolve()
        for text in inventory.raw_paths
        for part in (text, *text.split(", "))  # a record of several files has their paths in one text
    }
    for path in sorted((folder / "recordings").rglob(f"*{RECORDING_SUFFIX}")):
        if path.resolve() not in recorded and not is_set_aside(path):
            yield _without_record(path)


def _without_record(path: Path) -> Finding:
    from procedures.recording.errors import RecordingError  # MCAP only where there is a recording
    from procedures.recording.reader import read_recording

    try:
        recording = read_recording(path)
    except RecordingError as error:
        return Finding(name=str(path), verified=False, sentences=(f"It has no record, and cannot be read: {error}.",))
    if recording.header.job != "calibrate":
        words = "It has no record: it was measured and never calibrated, or its record was removed."
        return Finding(name=str(path), verified=True, sentences=(words,))
    if not recording.complete:
        words = "It has no record: the run did not come to its end; tumble resume goes on with it."
        return Finding(name=str(path), verified=True, sentences=(words,))
    words = "It has no record: that was removed from the store, or never came; tumble resume makes it anew."
    return Finding(name=str(path), verified=False, sentences=(words,))
