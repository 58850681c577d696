"""Samples of dwells at rest and under vibration, as they are read (CSV): one row a sample, some may be missing."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.rows import Kind, Rows, column
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.core.table import read_rows
from tumble.messages import Message

REST: Final = "rest"
VIBRATION: Final = "vibration"
RANDOM: Final = "random"
NEEDED: Final = ("dwell", "kind", "output_g")
"""Columns by which a table of samples is known."""
_FEWEST: Final = 16
"""Samples of a dwell."""


@dataclass(frozen=True, kw_only=True)
class SampleRows(Rows):
    """One row a sample; None where the table does not say."""

    settings: ClassVar = (*NEEDED, "time_s")

    dwell: NDArray[np.int64] = column("dwell", kind=Kind.WHOLE, required=True)
    """Number of the dwell."""
    kind: NDArray[np.str_] = column("kind", kind=Kind.TEXT, choices=(REST, VIBRATION, RANDOM), required=True)
    drive_hz: FloatArray | None = column("drive_Hz", unknown=np.nan)
    """Nominal frequency of the drive; 0 at rest, and where it is random."""
    output_g: FloatArray = column("output_g", needed=True, required=True)
    """Output of the unit divided by its scale factor, in g."""
    reference_i_g: FloatArray | None = column("reference_i_g", unknown=np.nan)
    """What the reference accelerometer says along the input axis, in g."""
    reference_o_g: FloatArray | None = column("reference_o_g", unknown=np.nan)


@dataclass(frozen=True, kw_only=True)
class Samples:
    """The samples of one dwell, in the order of their times; arrays of shape (samples,)."""

    dwell: int
    kind: str
    drive_hz: float
    """Nominal frequency; 0 where there is none."""
    time_s: FloatArray
    output_g: FloatArray
    references_g: tuple[FloatArray, ...]
    """Of the input axis, then of the output axis, as far as the table has them."""

    @property
    def step_s(self) -> float:
        """Time from sample to sample."""
        return float(np.median(np.diff(self.time_s)))

    @property
    def duration_s(self) -> float:
        """From the beginning of the first sample to the end of the last."""
        return float(np.ptp(self.time_s)) + self.step_s

    @property
    def middle_s(self) -> float:
        """Middle of the dwell."""
        return float(self.time_s[0] + self.time_s[-1]) / 2.0


@dataclass(frozen=True, kw_only=True)
class SampledDwells:
    """The dwells of a file."""

    dwells: tuple[Samples, ...]
    source: str = ""
    warnings: tuple[str, ...] = ()


def are_samples(header: Sequence[str]) -> bool:
    """Whether a table with these columns is one of samples of dwells."""
    return set(NEEDED) <= set(header)


def read_samples(path: Path) -> SampledDwells:
    """Read the samples of dwells. Samples without a finite output, reference or time are left out.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file; a dwell of which too few samples are left, whose times do not ascend, or
        whose drive is below 0 or faster than the samples.
    """
    rows = without_missing(read_rows(path, SampleRows), ("output_g",))
    numbers = list(dict.fromkeys(rows.dwell.tolist()))
    dwells = tuple(_dwell(rows.over(np.flatnonzero(rows.dwell == number)), path) for number in numbers)
    missing = len(rows.set_aside)
    told = Message.counted(
        "{path}: {count} sample holds no output and is left out",
        "{path}: {count} samples hold no output and are left out",
        count=missing,
        path=path,
    )
    return SampledDwells(dwells=dwells, source=str(path), warnings=(*rows.warnings, *([told] if missing else ())))


def _dwell(rows: SampleRows, path: Path) -> Samples:
    """One dwell. Raises `TableError`."""
    references = [each for each in (rows.reference_i_g, rows.reference_o_g) if each is not None]
    known = np.all([np.isfinite(each) for each in references], axis=0) if references else np.ones(len(rows), dtype=bool)
    rows = rows.select(known)
    number = int(rows.dwell[0]) if len(rows) else 0
    if len(rows) < _FEWEST:
        raise TableError(
            Message.counted(
                "{path}: dwell {number} has {count} sample; at least {fewest} are needed",
                "{path}: dwell {number} has {count} samples; at least {fewest} are needed",
                path=path,
                number=number,
                count=len(rows),
                fewest=_FEWEST,
            )
        )
    assert rows.time_s is not None, "a needed column"
    if not np.all(np.diff(rows.time_s) > 0):
        raise TableError(Message("{path}: the times of dwell {number} do not ascend", path=path, number=number))
    drive_hz = 0.0 if rows.drive_hz is None else float(np.nan_to_num(rows.drive_hz[0]))
    rate_hz = 1.0 / float(np.median(np.diff(rows.time_s)))
    if not 0.0 <= drive_hz <= rate_hz:
        raise TableError(
            Message(
                "{path}: drive_Hz of dwell {number} is {drive_hz:g}; it lies from 0 to the sampling rate, "
                "{rate_hz:.4g} Hz by time_s",
                path=path,
                number=number,
                drive_hz=drive_hz,
                rate_hz=rate_hz,
            )
        )
    return Samples(
        dwell=number,
        kind=str(rows.kind[0]),
        drive_hz=drive_hz,
        time_s=rows.time_s,
        output_g=rows.output_g,
        references_g=tuple(each for each in (rows.reference_i_g, rows.reference_o_g) if each is not None),
    )
