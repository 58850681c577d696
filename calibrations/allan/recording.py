"""A long still recording: outputs at equal steps of time, from a table (CSV)."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

import numpy as np

from tumble.calibrations.allan.deviations import FEWEST_SAMPLES
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.core.table import line_of, read_rows
from tumble.messages import Message

_GAP: Final = 1.5
"""Steps; a longer one is a gap."""


@dataclass(frozen=True, kw_only=True)
class StillRows(Rows):
    """Rows of a recording; its outputs stand in `extra`."""

    settings: ClassVar = ()


@dataclass(frozen=True, kw_only=True)
class StillRecording:
    """Outputs of a unit that was left alone."""

    outputs: Mapping[str, FloatArray]
    """By the names of their columns, which end in the unit."""
    rate_hz: float
    source: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def samples(self) -> int:
        """In each output."""
        return len(next(iter(self.outputs.values())))

    @property
    def duration_s(self) -> float:
        """From the beginning of the first sample to the end of the last."""
        return self.samples / self.rate_hz


def read_still(path: Path, rate_hz: float | None = None) -> StillRecording:
    """Read a recording: every column of numbers but times and temperatures is an output.

    The rate is that of `time_s`, or else given. Of a recording with gaps the longest stretch without one is used.

    Raises
    ------
    TableError
        Unreadable or malformed; no output; no rate; times that do not ascend; too short; an output that never changes.
    """
    rows = without_missing(read_rows(path, StillRows))
    outputs = {name: values.astype(float) for name, values in rows.extra.items() if _is_output(name, values)}
    if not outputs:
        raise TableError(Message("{path}: no column holds an output, such as u_x_V", path=path))
    whole = np.all([np.isfinite(values) for values in outputs.values()], axis=0)
    times, step_s = _times(rows, rate_hz, path)
    stretch = _longest(times[whole], np.flatnonzero(whole), step_s)
    kept = {name: values[whole][stretch] for name, values in outputs.items()}
    recording = StillRecording(
        outputs=kept, rate_hz=1.0 / step_s, source=str(path), warnings=(*rows.warnings, *_left_out(rows, stretch, path))
    )
    _check(recording, path)
    return recording


def _is_output(name: str, values: np.ndarray[tuple[int, ...], np.dtype[np.generic]]) -> bool:
    number = np.issubdtype(values.dtype, np.number)
    return number and not name.endswith("degC") and not name.startswith(("time", "timestamp"))


def _times(rows: StillRows, rate_hz: float | None, path: Path) -> tuple[FloatArray, float]:
    """Time of each row and the step between two, in s."""
    if rate_hz is not None:
        return rows.row / rate_hz, 1.0 / rate_hz
    if rows.time_s is None:
        raise TableError(Message("{path}: there is no column time_s; give the rate of the samples", path=path))
    steps_s = np.diff(rows.time_s)
    if len(steps_s) and steps_s.min() <= 0.0:
        row = int(rows.row[1:][steps_s <= 0.0][0])
        raise TableError(
            Message(
                "{path}, line {line}: time_s does not ascend; put the rows in order",
                path=path,
                line=line_of(path, row),
            )
        )
    typical_s = float(np.median(steps_s)) if len(steps_s) else 1.0
    unbroken = steps_s[steps_s < _GAP * typical_s]
    return rows.time_s, float(unbroken.mean()) if len(unbroken) else typical_s


def _longest(times: FloatArray, places: np.ndarray[tuple[int, ...], np.dtype[np.intp]], step_s: float) -> slice:
    """The longest stretch of rows without a gap."""
    ends = np.flatnonzero((np.diff(times) > _GAP * step_s) | (np.diff(places) > 1)) + 1
    bounds = np.concatenate([[0], ends, [len(times)]])
    longest = int(np.argmax(np.diff(bounds)))
    return slice(int(bounds[longest]), int(bounds[longest + 1]))


def _left_out(rows: StillRows, stretch: slice, path: Path) -> tuple[str, ...]:
    used = stretch.stop - stretch.start
    if used == rows.rows_read:
        return ()
    return (
        Message(
            "{path}: there are gaps; the longest stretch without one is used (rows: {used} of {rows})",
            path=path,
            used=used,
            rows=rows.rows_read,
        ),
    )


def _check(recording: StillRecording, path: Path) -> None:
    if recording.samples < FEWEST_SAMPLES:
        raise TableError(
            Message.counted(
                "{path}: {count} sample without a gap; {fewest} are the fewest",
                "{path}: {count} samples without a gap; {fewest} are the fewest",
                path=path,
                count=recording.samples,
                fewest=FEWEST_SAMPLES,
            )
        )
    for name, values in recording.outputs.items():
        if np.ptp(values) == 0.0:
            raise TableError(
                Message("{path}, column {name}: never changes; it tells nothing of the noise", path=path, name=name)
            )
