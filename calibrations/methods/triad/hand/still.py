"""Still intervals of a log that was moved by hand (after Tedaldi, Pretto and Menegatti, ICRA 2014).

A sample is still where the outputs of the window round it scatter by less than `TIMES` the quiet level: the scatter
that the quietest tenth of all windows does not exceed. The way in and out of every interval is left out.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

WINDOW_S: Final = 2.0
TIMES: Final = 2.0
QUIETEST: Final = 0.1
SHORTEST_S: Final = 2.0
"""Shorter intervals are not used."""
_EDGE_S: Final = 0.2


@dataclass(frozen=True, kw_only=True)
class Pose:
    """What was read while the unit was held still."""

    start_s: float
    length_s: float
    samples: int
    mean: FloatArray
    """Shape (3,)."""
    deviation: FloatArray
    """Standard deviation of the samples, shape (3,)."""
    mean_deviation: FloatArray
    """Of the mean, by the means of tenths of the interval, so that slow noise counts, shape (3,)."""


def still_poses(time_s: FloatArray, outputs: FloatArray) -> tuple[Pose, ...]:
    """The poses of a log, in the order of time; times ascend."""
    step_s = float(np.median(np.diff(time_s)))
    window = max(round(WINDOW_S / step_s), 3)
    if len(time_s) <= window:
        return ()
    scatter = _window_scatter(outputs, window)
    quiet = scatter < TIMES * float(np.quantile(scatter, QUIETEST))
    still = np.convolve(quiet.astype(float), np.ones(window))[: len(time_s)] > 0
    edge = round(_EDGE_S / step_s)
    found = []
    for start, stop in _runs(still):
        first, last = start + edge, stop - edge
        if last > first and time_s[last - 1] - time_s[first] >= SHORTEST_S:
            found.append(_pose(time_s[first:last], outputs[first:last]))
    return tuple(found)


def _window_scatter(outputs: FloatArray, window: int) -> FloatArray:
    """Standard deviation of all outputs together in the window that begins at each sample."""
    centred = outputs - outputs.mean(axis=0)
    sums = np.vstack([np.zeros(3), np.cumsum(centred, axis=0)])
    squares = np.vstack([np.zeros(3), np.cumsum(centred**2, axis=0)])
    mean = (sums[window:] - sums[:-window]) / window
    variance = (squares[window:] - squares[:-window]) / window - mean**2
    return np.asarray(np.sqrt(np.maximum(variance, 0.0).sum(axis=1)))


def _runs(still: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> list[tuple[int, int]]:
    """First and one past the last sample of each run of still ones."""
    steps = np.diff(np.concatenate([[0], still.astype(int), [0]]))
    return list(zip(np.flatnonzero(steps == 1).tolist(), np.flatnonzero(steps == -1).tolist(), strict=True))


def _pose(time_s: FloatArray, outputs: FloatArray) -> Pose:
    tenths = np.array([part.mean(axis=0) for part in np.array_split(outputs, 10)])
    return Pose(
        start_s=float(time_s[0]),
        length_s=float(time_s[-1] - time_s[0]),
        samples=len(outputs),
        mean=outputs.mean(axis=0),
        deviation=outputs.std(axis=0, ddof=1),
        mean_deviation=tenths.std(axis=0, ddof=1) / np.sqrt(10.0),
    )
