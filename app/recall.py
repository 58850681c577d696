"""Stored records, and the raw files that they come from."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from app.calibrating import fit, trace
from app.identity import program_identity
from app.measurements import Measurement, read_measurement
from calibrations.records.errors import StoreError
from calibrations.records.record import Record
from calibrations.records.store import Store
from calibrations.records.verify import Verification, verify
from procedures.errors import InputError


def open_store(folder: Path) -> Store:
    """Open a store for reading. Raises `InputError` where there is none."""
    try:
        return Store.existing(folder)
    except StoreError as error:
        raise InputError(str(error)) from error


def recall(folder: Path, record_id: str) -> tuple[Record, Measurement]:
    """A record, by the beginning of its id, with its raw file. Raises `InputError`, `RecordError`, `StoreError`."""
    store = open_store(folder)
    record = store.get(record_id)
    return record, read_measurement(store.raw_file(record), record.provenance.stand)


def verify_record(store: Store, record: Record) -> Verification:
    """Hash again, fit again from the raw file, compare."""
    return verify(record, store, _refit, program_identity().version)


def _refit(path: Path, stand: Mapping[str, Any]) -> dict[str, Any]:
    return trace(fit(read_measurement(path, stand), trials=0)).as_json()
