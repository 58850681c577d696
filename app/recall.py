"""Stored records, and the raw files that they come from."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tumble.app.adopted_effects import as_offered
from tumble.app.analysing import fit, trace
from tumble.app.files import is_recording
from tumble.app.identity import program_identity
from tumble.app.jobs import measured_at_stand
from tumble.app.joining import read_together
from tumble.app.measurement import Measurement
from tumble.app.methods import methods
from tumble.app.opening import open_store
from tumble.app.stand_records import corrected_by
from tumble.calibrations.core.method import Method
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.errors import RecordError, StoreError
from tumble.calibrations.records.raw import file_sha256
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.verify import Verification, verify
from tumble.messages import Message
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.header import Header

if TYPE_CHECKING:
    from tumble.calibrations.records.store import Store


def recall(folder: Path, record_id: str) -> tuple[Record, Measurement]:
    """A record, by the beginning of its id, with its raw file. Raises `InputError`, `RecordError`, `StoreError`."""
    store = open_store(folder)
    record = store.get(record_id)
    if not measured_at_stand(record.method, store.raw_files(record)):
        raise RecordError(
            Message(
                "record {record_id} is of method {method}, which only records show and export know",
                record_id=record.id,
                method=record.method,
            )
        )
    measurement = read_together(store.raw_files(record), record.provenance.stand)
    return record, _as_corrected(measurement.of_lot(record.provenance.lot), record, folder)


def record_of(recording: Path, header: Header, folder: Path) -> Record | None:
    """The record of a recording that stands in a store; None where there is none."""
    from tumble.calibrations.records.store import Store

    try:
        return Store.existing(folder).of_files(header.serial_number, header.method, [file_sha256(recording)])
    except StoreError:
        return None


def verify_record(store: "Store", record: Record) -> Verification:
    """Hash again, fit again from the raw files, compare."""
    method = next((each for each in methods() if each.name == record.method), None)
    refit = None if method is None else partial(_refit, method, record, store.folder)
    return verify(record, store, refit, program_identity().version)


def _refit(method: Method, record: Record, folder: Path, paths: Sequence[Path], stand: Mapping[str, Any]) -> Entry:
    """How the numbers of a record come back from its raw files."""
    if not measured_at_stand(method.name, paths):
        return method.close_loop(paths).entry()
    measurement = _as_corrected(read_together(paths, stand), record, folder)
    return trace(fit(measurement, trials=0)).entry


def unprotected(raw_files: Sequence[Path]) -> str:
    """A sentence where a raw file of a record is a recording of an older format; nothing else is to be said."""
    return next(filter(None, map(_unprotected, raw_files)), "")


def _unprotected(raw_file: Path) -> str:
    if not (is_recording(raw_file) and raw_file.is_file()):
        return ""
    from tumble.procedures.recording.reader import read_header  # MCAP only where there is a recording

    try:
        header = read_header(raw_file)
    except RecordingError:
        return ""
    if header.protected:
        return ""
    return Message(
        "The recording is of format {format_version}, in which the header has no checksum: damage to it "
        "from before the record was made would not be noticed.",
        format_version=header.format_version,
    )


def _as_corrected(measurement: Measurement, record: Record, folder: Path) -> Measurement:
    """The measurement with the stand record and the adopted effects of when it was calibrated, and no others."""
    measurement = as_offered(measurement, record.result.get("adopted_effects", ()), folder)
    applied = record.result.get("stand_record")
    if applied is None:
        return measurement
    from tumble.calibrations.stand_records.store import StandRecords

    stand_record = StandRecords(folder).get(applied["id"])
    if stand_record.content_sha256 != applied["content_sha256"] or not stand_record.intact:
        raise RecordError(
            Message(
                "{folder}: stand record {version} is not the one that was applied; restore it",
                folder=folder,
                version=stand_record.version,
            )
        )
    return corrected_by(stand_record, measurement)
