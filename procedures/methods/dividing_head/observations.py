"""A recording as the table that the analysis reads."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.screening import set_aside_bad_rows
from tumble.procedures.methods.dividing_head.rows import Row, row_of
from tumble.procedures.recording.endings import warnings
from tumble.procedures.recording.recorded import Recording


def observations(recording: Recording) -> Observations:
    """Reduce a recording to its observation table: one row per completed point, rows without a measurement set aside.

    `complete` is false, and `warnings` says why, where the file was cut off or the run ended early. The warnings of the
    run itself come first.
    """
    rows = [row_of(point) for point in recording.points]
    table = Observations(
        row=np.arange(1, len(rows) + 1),
        angle_deg=_numbers(rows, "angle_deg"),
        voltage_v=_numbers(rows, "voltage_v"),
        time_s=_numbers(rows, "time_s"),
        realisation=_counts(rows, "realisation"),
        procedure=_names(rows, "procedure"),
        mount=_names(rows, "mount"),
        direction=_counts(rows, "direction"),
        temperature_degc=_temperatures(rows),
        voltage_sd_v=_numbers(rows, "voltage_sd_v"),
        samples=_counts(rows, "samples"),
        take=recording.takes,
        warnings=tuple(warnings(recording)),
        complete=recording.complete,
        source=str(recording.path),
    )
    return set_aside_bad_rows(table)


def _numbers(rows: Sequence[Row], name: str) -> FloatArray:
    return np.array([getattr(row, name) for row in rows], dtype=np.float64)


def _counts(rows: Sequence[Row], name: str) -> NDArray[np.int64]:
    return np.array([getattr(row, name) for row in rows], dtype=np.int64)


def _names(rows: Sequence[Row], name: str) -> NDArray[np.str_]:
    return np.array([getattr(row, name) for row in rows], dtype=np.str_)


def _temperatures(rows: Sequence[Row]) -> FloatArray | None:
    """Give NaN where a single temperature is missing; None where all are."""
    if all(row.temperature_degc is None for row in rows):
        return None
    return _numbers(rows, "temperature_degc")
