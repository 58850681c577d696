"""Runs of a store that came to no record: cut off, stopped, or measured to the end and never analysed."""

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from tumble.app.files import RECORDING_SUFFIX
from tumble.app.opening import open_store
from tumble.app.resuming import find, is_set_aside
from tumble.calibrations.records.errors import StoreError
from tumble.procedures.errors import InputError


@dataclass(frozen=True, kw_only=True)
class CutOff:
    """A run that can go on."""

    path: Path
    method: str
    """Name of its method."""
    serial_number: str
    programme_name: str
    points: int
    ending: str
    """Why it ended; empty where it broke off."""
    stand_name: str
    began_at: datetime


def cut_off_runs(folder: Path) -> tuple[CutOff, ...]:
    """The runs of a store without a record, the newest last; what is no recording is passed over."""
    recorded = _recorded(folder)
    paths = sorted((folder / "recordings").glob(f"*/*{RECORDING_SUFFIX}"), key=lambda path: path.name)
    wanted = (path for path in paths if not is_set_aside(path) and path.resolve() not in recorded)
    return tuple(found for path in wanted for found in _cut_off(path))


def _cut_off(path: Path) -> Iterator[CutOff]:
    try:
        unfinished = find(path)
        programme_name = unfinished.programme.name
    except InputError:
        return
    recording = unfinished.recording
    if recording.header.job == "calibrate":
        yield CutOff(
            path=path,
            method=recording.header.method,
            serial_number=recording.header.serial_number,
            programme_name=programme_name,
            points=len(recording.points),
            ending=str(recording.ending.reason) if recording.ending else "",
            stand_name=str(recording.header.stand.get("name", "")),
            began_at=datetime.fromtimestamp(recording.header.started_wall_ns / 1e9, tz=UTC),
        )


def _recorded(folder: Path) -> frozenset[Path]:
    """The raw files of every record."""
    try:
        return frozenset(path.resolve() for path in open_store(folder).recorded_files())
    except (InputError, StoreError):
        return frozenset()
