"""A recording as the table that the analysis reads."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.screening import set_aside_bad_rows
from tumble.procedures.events import FinishReason, WarningRaised
from tumble.procedures.recording.reader import Recording
from tumble.procedures.steps import Point

_TOLD = 5
"""So many damages or missing points are named."""


def observations(recording: Recording) -> Observations:
    """Reduce a recording to its observation table: one row per completed point, rows without a measurement set aside.

    `complete` is false, and `warnings` says why, where the file was cut off or the run ended early. The warnings of the
    run itself come first.
    """
    points = recording.points
    table = Observations(
        row=np.arange(1, len(points) + 1),
        angle_deg=_numbers(points, "angle_deg"),
        voltage_v=_numbers(points, "voltage_v"),
        time_s=_numbers(points, "time_s"),
        realisation=_counts(points, "realisation"),
        procedure=_names(points, "procedure"),
        mount=_names(points, "mount"),
        direction=_counts(points, "direction"),
        temperature_degc=_temperatures(points),
        voltage_sd_v=_numbers(points, "voltage_sd_v"),
        samples=_counts(points, "samples"),
        warnings=_warnings(recording),
        complete=recording.complete,
        source=str(recording.path),
    )
    return set_aside_bad_rows(table)


def _numbers(points: Sequence[Point], name: str) -> FloatArray:
    return np.array([getattr(point, name) for point in points], dtype=np.float64)


def _counts(points: Sequence[Point], name: str) -> NDArray[np.int64]:
    return np.array([getattr(point, name) for point in points], dtype=np.int64)


def _names(points: Sequence[Point], name: str) -> NDArray[np.str_]:
    return np.array([getattr(point, name) for point in points], dtype=np.str_)


def _temperatures(points: Sequence[Point]) -> FloatArray | None:
    """Give NaN where a single temperature is missing; None where all are."""
    if all(point.temperature_degc is None for point in points):
        return None
    return _numbers(points, "temperature_degc")


def _warnings(recording: Recording) -> tuple[str, ...]:
    of_the_run = (event.message for event in recording.events if isinstance(event, WarningRaised))
    return (*of_the_run, *_ending_warnings(recording))


def _ending_warnings(recording: Recording) -> Iterator[str]:
    kept = f"its {len(recording.points)} complete points are used"
    if recording.damage:
        yield f"{recording.path} is damaged: {_some(recording.damage)}; {kept}"
    elif not recording.closed:
        yield f"{recording.path} was cut off or damaged; {kept}"
    elif recording.ending is None:
        yield f"{recording.path} holds no end of the run; {kept}"
    if recording.missing:
        yield f"{recording.path} lacks {_listed(recording.missing)}, recorded before others that are there; {kept}"
    if recording.ending is not None and recording.ending.reason is not FinishReason.COMPLETED:
        yield f"{recording.path} holds a run that ended early ({recording.ending.reason}); {kept}"


def _listed(missing: Sequence[int]) -> str:
    points = "point" if len(missing) == 1 else f"{len(missing)} points,"
    return f"{points} {_some([str(index) for index in missing])} (counted from 0)"


def _some(clauses: Sequence[str]) -> str:
    """The first few, and how many more there are."""
    more = [f"and {len(clauses) - _TOLD} more"] if len(clauses) > _TOLD else []
    return ", ".join([*clauses[:_TOLD], *more])
