"""Raw files, recordings and tables alike, read as what the analysis needs of them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from tumble.app.files import is_recording
from tumble.app.header_checks import check_header
from tumble.app.identity import program_identity
from tumble.app.jobs import find_job, has_job, method_of_table
from tumble.app.measurement import Measurement
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance, inside
from tumble.calibrations.core.rows import Rows, SetAside
from tumble.calibrations.core.sentences import series
from tumble.calibrations.records.raw import file_sha256
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.events import Identified
from tumble.procedures.programme import Programme
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.registry import find_method


def read_measurement(path: Path, stand: Mapping[str, Any] | None = None) -> Measurement:
    """Read a recording (`.mcap`) or an observation table.

    Parameters
    ----------
    path
        File to read.
    stand
        Stand file as data, in place of what the recording holds.

    Raises
    ------
    InputError
        Unreadable or malformed, or without a single complete point: one sentence.
    """
    measurement = (_read_recording if is_recording(path) else _read_table)(path, stand)
    if not len(measurement.observations):
        raise InputError(_nothing(path, measurement.observations.set_aside))
    return measurement


def _nothing(path: Path, aside: Sequence[SetAside]) -> Message:
    """Why a file holds no row that can be used."""
    if not aside:
        return Message("{path}: no usable row; measure again", path=path)
    return Message(
        "{path}: no usable row, {count} set aside (row {row}: {reason}); correct the table, or measure again",
        path=path,
        count=len(aside),
        row=aside[0].row,
        reason=aside[0].reason,
    )


def _read_table(path: Path, stand: Mapping[str, Any] | None) -> Measurement:
    method = method_of_table(path)
    try:
        rows = find_job(method).read_table(path)
    except TableError as error:
        raise InputError(str(error)) from error
    return Measurement(path=path, sha256=file_sha256(path), method=method, observations=rows, stand=stand or {})


def _read_recording(path: Path, stand: Mapping[str, Any] | None) -> Measurement:
    from tumble.procedures.recording.reader import read_recording  # MCAP only where there is a recording

    try:
        recording = read_recording(path)
    except RecordingError as error:
        raise InputError(str(error)) from error
    header = recording.header
    check_header(path, header, stand)
    if stand is not None:
        recording = replace(recording, header=replace(header, stand=stand))
    table = find_method(header.method).procedure_part.table(recording)
    if not (has_job(header.method) and isinstance(table, Rows)):
        raise InputError(
            Message(
                "{path}: is of the method {method}, which this does not analyse; use its own command",
                path=path,
                method=header.method,
            )
        )
    return Measurement(
        path=path,
        sha256=file_sha256(path),
        method=header.method,
        observations=table,
        stand=header.stand if stand is None else stand,
        header=header,
        lot=header.lot,
        serials={event.instrument: event.serial for event in recording.events if isinstance(event, Identified)},
    )


def provenance(measurement: Measurement, serial_number: str = "", folder: Path | None = None) -> Provenance:
    """Where a calibration of `measurement` comes from; paths are relative to `folder` inside it."""
    header, program = measurement.header, program_identity()
    files = (measurement, *measurement.others)
    programme = measurement.programme
    return Provenance(
        serial_number=serial_number or (header.serial_number if header else "") or measurement.path.stem,
        lot=measurement.lot,
        operator=header.operator if header else "",
        programme_name=programme.name if programme else "",
        programme_sha256=header.programme_sha256 if header else "",
        stand_name=str(measurement.stand.get("name", "")),
        stand=measurement.stand,
        sources=tuple(file.source(folder or Path()) for file in files),
        measured_at=_iso(header.started_wall_ns) if header else "",
        program_version=program.version,
        git_commit=program.git_commit,
        git_dirty=program.git_dirty,
        packages=program.packages,
    )


def check_limits(parameters: Mapping[str, Parameter], programme: Programme | None) -> tuple[LimitCheck, ...]:
    """Hold values against the programme's limits; what has no value is not inside. The verdict takes more than that.

    Raises
    ------
    InputError
        It limits what is no parameter of its method.
    """
    limits = programme.limits if programme else {}
    if unknown := sorted(set(limits) - set(parameters)):
        raise InputError(
            Message(
                "the programme limits {name}, and the parameters are {parameters}; correct it",
                name=unknown[0],
                parameters=series(list(parameters)),
            )
        )
    checks = (LimitCheck(name=name, minimum=each.min, maximum=each.max, inside=False) for name, each in limits.items())
    return tuple(_held(check, parameters[check.name].value) for check in checks)


def _held(check: LimitCheck, value: float | None) -> LimitCheck:
    return replace(check, inside=value is not None and inside(value, check))


def _iso(wall_ns: int) -> str:
    return datetime.fromtimestamp(wall_ns / 1e9, tz=UTC).isoformat(timespec="seconds")
