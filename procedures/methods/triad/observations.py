"""A recording as the table that the analysis reads."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.procedures.methods.triad.layout import CHANNELS, INNER, OUTER
from tumble.procedures.recording.endings import warnings
from tumble.procedures.recording.recorded import Recording
from tumble.procedures.steps import Point


def observations(recording: Recording) -> TriadObservations:
    """One row per completed point, rows without a measurement set aside.

    `complete` is false, and `warnings` says why, where the file was cut off or the run ended early.
    """
    points = recording.points
    columns: dict[str, Any] = {f"{name}_direction": _directions(points, name) for name in (OUTER, INNER)}
    for channel in CHANNELS:
        axis = channel.split("_")[1]
        columns[f"u_{axis}_v"] = _numbers([point.readings[channel].mean for point in points])
        columns[f"sd_{axis}_v"] = _numbers([point.readings[channel].sd for point in points])
        columns[f"temperature_{axis}_degc"] = _known([point.readings[channel].temperature_degc for point in points])
    table = TriadObservations(
        row=np.arange(1, len(points) + 1),
        outer_deg=_numbers([point.positions_deg[OUTER] for point in points]),
        inner_deg=_numbers([point.positions_deg[INNER] for point in points]),
        time_s=_numbers([point.time_s for point in points]),
        realisation=np.array([point.realisation for point in points], dtype=np.int64),
        temperature_degc=_known([point.temperature_degc for point in points]),
        samples=np.array([point.readings[CHANNELS[0]].samples for point in points], dtype=np.int64),
        take=recording.takes,
        warnings=tuple(warnings(recording)),
        complete=recording.complete,
        source=str(recording.path),
        **columns,
    )
    return without_missing(table, ("u_x_v", "u_y_v", "u_z_v"))


def _numbers(values: Sequence[float]) -> FloatArray:
    return np.array(values, dtype=np.float64)


def _directions(points: Sequence[Point], name: str) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    return np.array([point.directions[name] for point in points], dtype=np.int64)


def _known(values: Sequence[float | None]) -> FloatArray | None:
    """NaN where a single one is missing; None where all are."""
    return None if all(value is None for value in values) else np.array(values, dtype=np.float64)
