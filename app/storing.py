"""Results kept as records."""

from collections.abc import Sequence
from pathlib import Path

from tumble.app import reports
from tumble.app.exits import Exit, JobError
from tumble.app.identity import program_identity
from tumble.app.kept_reports import keep, of_record
from tumble.app.methods import close_loop, method_called
from tumble.app.opening import store_to_write
from tumble.app.section_report import table_report
from tumble.calibrations.core.method import Method, Result
from tumble.calibrations.core.provenance import Provenance, Source
from tumble.calibrations.records.errors import RecordError, StoreError
from tumble.calibrations.records.raw import file_sha256, stored_path
from tumble.calibrations.records.record import Record
from tumble.messages import Language, Message
from tumble.procedures.errors import InputError


def record_tables(result: Result, files: Sequence[Path], folder: Path) -> Record:
    """Store what tables say that were measured elsewhere. Raises `InputError`, `JobError`."""
    try:
        return store_to_write(folder).revise(result.entry(), origin_of_tables(files, folder))
    except ValueError as error:
        raise InputError(str(error)) from error
    except StoreError as error:
        raise JobError(Message("{error}; nothing was recorded", error=error), Exit.STORAGE) from error


def traced_again(record: Record, files: Sequence[Path]) -> tuple[Method, Result]:
    """Trace the tables of a record again, with its method. Raises `InputError`, `RecordError`."""
    try:
        method = method_called(record.method)
    except LookupError as error:
        raise RecordError(
            Message(
                "record {record_id} is of method {method}, which only records show and export know",
                record_id=record.id,
                method=record.method,
            )
        ) from error
    return method, close_loop(method, files)


def report_tables(method: Method, result: Result, record: Record, folder: Path, path: Path, language: Language) -> None:
    """Write the report of a record of tables in a language, and keep in its store what it says. Raises `JobError`."""
    name = Path(record.provenance.sources[-1].path).name
    said = table_report(method, result, record.provenance, name, record.id)
    report = of_record(said, record, folder)
    keep(report, record, folder)
    reports.write(report, path, language)


def origin_of_tables(files: Sequence[Path], folder: Path | None) -> Provenance:
    """Where a result of tables comes from; `folder` is that of the store, None where there is none."""
    program = program_identity()
    return Provenance(
        serial_number=files[-1].stem,
        operator="",
        programme_name="",
        programme_sha256="",
        stand_name="",
        stand={},
        sources=tuple(
            Source(kind="table", path=stored_path(folder, path) if folder else str(path), sha256=file_sha256(path))
            for path in files
        ),
        measured_at="",
        program_version=program.version,
        git_commit=program.git_commit,
        git_dirty=program.git_dirty,
        packages=program.packages,
    )
