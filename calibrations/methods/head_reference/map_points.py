"""The error of a head as points of a map, and another map interpolated to them."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import SAME_ANGLE_DEG
from tumble.calibrations.methods.head_reference.explanation import Explanation
from tumble.calibrations.tracing.linear_loop import rms

_WIDE = 4.0
"""Between points so many times as far apart as is usual nothing is interpolated."""
_LINEAR: Final = 1.5
"""Variance of a point beside the line through its neighbours, in variances of a point."""


@dataclass(frozen=True, kw_only=True)
class MapPoints:
    """Settings of one table, or its dwells where none came back, by direction and then by angle."""

    angle_deg: FloatArray
    direction: NDArray[np.int64]
    error_deg: FloatArray
    """Reference minus head, shape (points,); what a late reference adds is taken off."""
    uncertainty_deg: FloatArray | None
    """Standard uncertainty of each, from repeats; of a stream, from what is left; None where neither says."""
    degrees_of_freedom: int
    """Of that."""

    def side(self, direction: int) -> NDArray[np.int64]:
        """Points that were reached in one direction."""
        return np.flatnonzero(self.direction == direction)


@dataclass(frozen=True, kw_only=True)
class Interpolated:
    """One map at angles of another."""

    seen: NDArray[np.bool_]
    """At which of the angles it has points on both sides, or one that coincides, shape (angles,)."""
    error_deg: FloatArray
    """Shape (angles,); meaningless where not seen."""
    variance_deg2: FloatArray
    """Of repeats and of the line between two points; 0 where the map has no uncertainty of its own."""


def map_points(explanation: Explanation) -> MapPoints:
    """The error of a head by angle and direction, as one table has it."""
    scene, settings = explanation.seen_scene, explanation.settings
    angle_deg = settings.means(scene.angle_deg + scene.late_deg)
    error_deg = settings.means(explanation.settled_deg - scene.late_deg)
    direction = scene.direction[np.unique(settings.number, return_index=True)[1]]
    order = np.lexsort((angle_deg, direction))
    uncertainty_deg, freedom = _uncertainty(explanation)
    return MapPoints(
        angle_deg=angle_deg[order],
        direction=direction[order],
        error_deg=error_deg[order],
        uncertainty_deg=None if uncertainty_deg is None else uncertainty_deg[order],
        degrees_of_freedom=freedom,
    )


def _uncertainty(explanation: Explanation) -> tuple[FloatArray | None, int]:
    """Of each setting, and its degrees of freedom."""
    settings = explanation.settings
    if settings.repeated:
        error = settings.pure_error(explanation.settled_deg)
        return np.asarray(error.standard_deviation / np.sqrt(settings.visits)), error.degrees_of_freedom
    if settings.streamed:  # neighbours err alike: the scatter beside them would promise too much
        return np.full(len(settings.visits), rms(explanation.residual_deg)), explanation.parts
    return None, 0


def interpolated(points: MapPoints, side: NDArray[np.int64], at_deg: FloatArray) -> Interpolated:
    """One side of a map at other angles, by straight lines between neighbouring points, on its own arc only."""
    angle_deg, error_deg = points.angle_deg[side], points.error_deg[side]
    own = np.zeros(len(side)) if points.uncertainty_deg is None else points.uncertainty_deg[side] ** 2
    if len(side) < 2:
        near = np.abs(at_deg - angle_deg[0]) <= SAME_ANGLE_DEG if len(side) else np.zeros(len(at_deg), dtype=bool)
        filled = np.full(len(at_deg), error_deg[0] if len(side) else np.nan)
        return Interpolated(seen=near, error_deg=filled, variance_deg2=np.full(len(at_deg), own.sum()))
    right = np.clip(np.searchsorted(angle_deg, at_deg), 1, len(side) - 1)
    left = right - 1
    gap_deg = np.maximum(angle_deg[right] - angle_deg[left], 1e-12)
    part = (at_deg - angle_deg[left]) / gap_deg
    for end, place in ((0.0, left), (1.0, right)):
        part = np.where(np.abs(at_deg - angle_deg[place]) <= SAME_ANGLE_DEG, end, part)
    usual = gap_deg <= _WIDE * float(np.median(np.diff(angle_deg)))
    bend = 4.0 * part * (1.0 - part) * _bend_deg(angle_deg, error_deg, own)
    return Interpolated(
        seen=(part == 0.0) | (part == 1.0) | ((part > 0.0) & (part < 1.0) & usual),
        error_deg=(1.0 - part) * error_deg[left] + part * error_deg[right],
        variance_deg2=(1.0 - part) ** 2 * own[left] + part**2 * own[right] + bend**2,
    )


def beside_neighbours(angle_deg: FloatArray, values: FloatArray) -> FloatArray:
    """What inner points differ by from the line through their two neighbours, angles ascending, shape (points - 2,)."""
    span_deg = np.maximum(angle_deg[2:] - angle_deg[:-2], 1e-12)
    part = (angle_deg[1:-1] - angle_deg[:-2]) / span_deg
    return np.asarray(values[1:-1] - (1.0 - part) * values[:-2] - part * values[2:])


def neighbours_deviation(differences: FloatArray) -> float:
    """Standard deviation of a point, from what points differ by from the line through their neighbours."""
    return rms(differences) / float(np.sqrt(_LINEAR)) if len(differences) else float("nan")


def _bend_deg(angle_deg: FloatArray, error_deg: FloatArray, variance_deg2: FloatArray) -> float:
    """How far the map bends from the line half way between two points: a quarter of that over twice the distance."""
    if len(angle_deg) < 3 or not variance_deg2.any():
        return 0.0
    squares = float(np.mean(beside_neighbours(angle_deg, error_deg) ** 2))
    return float(np.sqrt(max(squares - _LINEAR * float(np.mean(variance_deg2)), 0.0))) / 4.0
