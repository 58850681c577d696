"""Results kept as records."""

from collections.abc import Sequence
from pathlib import Path

from tumble.app.exits import Exit, JobError
from tumble.app.identity import program_identity
from tumble.calibrations.core.method import Result
from tumble.calibrations.core.provenance import Provenance, Source
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.raw import file_sha256, stored_path
from tumble.calibrations.records.record import Record
from tumble.messages import Message
from tumble.procedures.errors import InputError


def record_tables(result: Result, files: Sequence[Path], folder: Path) -> Record:
    """Store what tables say that were measured elsewhere. Raises `InputError`, `JobError`."""
    from tumble.calibrations.records.store import Store

    try:
        return Store(folder).revise(result.entry(), origin_of_tables(files, folder))
    except ValueError as error:
        raise InputError(str(error)) from error
    except StoreError as error:
        raise JobError(Message("{error}; nothing was recorded", error=error), Exit.STORAGE) from error


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
