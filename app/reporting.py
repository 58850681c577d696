"""The report of a record, written again: by what was kept of it, or else from its raw files."""

from collections.abc import Sequence
from pathlib import Path

from tumble.app import reports
from tumble.app.jobs import measured_at_stand
from tumble.app.kept_reports import kept, report_path
from tumble.app.opening import open_store
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.raw import file_sha256
from tumble.calibrations.records.record import Record
from tumble.messages import Language, Message


def report_again(folder: Path, record_id: str, language: Language, path: Path | None = None) -> Path:
    """Write the report of a record, by the beginning of its id, in a language; its place.

    Raises
    ------
    InputError, RecordError, StoreError
        There is no such record, or its raw files are not what they were or cannot be analysed.
    JobError
        The report cannot be written.
    """
    store = open_store(folder)
    record = store.get(record_id)
    place = path or report_path(folder, record)
    if content := kept(store, record, language):
        reports.put(content, place)
        return place
    files = store.raw_files(record)
    _check_unchanged(record, files)
    if measured_at_stand(record.method, files):
        _report_run(record, folder, place, language)
    else:
        _report_tables(record, files, folder, place, language)
    return place


def _check_unchanged(record: Record, files: Sequence[Path]) -> None:
    """Refuse a file that another record may have been made from; one that is gone is told of by whoever reads it."""
    for path, sha256 in zip(files, record.provenance.source_hashes, strict=True):
        if path.is_file() and file_sha256(path) != sha256:
            raise RecordError(
                Message(
                    "record {record_id}: {path} is not as it was when the record was made, and no report of the "
                    "record is written from it; put the file back that it was",
                    record_id=record.id,
                    path=path,
                )
            )


def _report_run(record: Record, folder: Path, place: Path, language: Language) -> None:
    from tumble.app.analysing import fit, trace  # what is kept needs no analysis
    from tumble.app.calibrating import report_record
    from tumble.app.recall import recall

    record, measurement = recall(folder, record.id)
    analysed = fit(measurement, record.provenance.serial_number, folder=folder)
    report_record(trace(analysed), record, folder, place, language)


def _report_tables(record: Record, files: Sequence[Path], folder: Path, place: Path, language: Language) -> None:
    from tumble.app.storing import report_tables, traced_again

    method, result = traced_again(record, files)
    report_tables(method, result, record, folder, place, language)
