"""Two tables of one head as maps: the difference of the errors by angle and direction, and whether it is a constant.

A constant part is what the set-up moved by (the reference was mounted anew), and no change of the head. Coefficients of
two tables are never held against each other: two lists may name the same error differently.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.map_points import (
    MapPoints,
    beside_neighbours,
    interpolated,
    map_points,
    neighbours_deviation,
)
from tumble.messages import Message

CHANGED_P = 1e-3
"""A head has changed where chance makes a difference vary as much more seldom than this."""
_FEWEST = 3
_PARTS = 6
_FEW = 12
"""So many points of one direction are shown one by one."""
_FAR = 3.0
"""A part differs from the constant by so many standard uncertainties."""


@dataclass(frozen=True, kw_only=True)
class Difference:
    """The second map minus the first, at angles that both visited in the same direction."""

    angle_deg: FloatArray
    direction: NDArray[np.int64]
    difference_deg: FloatArray
    uncertainty_deg: FloatArray
    degrees_of_freedom: int
    """Of the uncertainty."""
    basis: str
    """From what the uncertainty comes, in words."""

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.angle_deg)

    @property
    def constant_deg(self) -> float:
        """Weighted mean: the set-up offset."""
        return float(np.average(self.difference_deg, weights=self.uncertainty_deg**-2.0))

    @property
    def constant_uncertainty_deg(self) -> float:
        """Standard uncertainty of the set-up offset; larger by what the difference varies by, where that is more."""
        own = float(np.sum(self.uncertainty_deg**-2.0) ** -0.5)
        return own * max(1.0, float(np.sqrt(self.f)))

    @property
    def f(self) -> float:
        """Mean square of the difference about its constant part, in variances of a point."""
        left = (self.difference_deg - self.constant_deg) / self.uncertainty_deg
        return float(np.sum(left**2)) / (len(self) - 1)

    @property
    def p_value(self) -> float:
        """Chance of so large a variation if nothing but the set-up had moved."""
        from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

        return float(fdtrc(len(self) - 1, self.degrees_of_freedom, self.f))

    @property
    def varies(self) -> bool:
        """Whether it is more than a constant."""
        return self.p_value < CHANGED_P


@dataclass(frozen=True, kw_only=True)
class Part:
    """The difference over one part of the arc, in one direction."""

    direction: int
    from_deg: float
    to_deg: float
    mean_deg: float
    uncertainty_deg: float
    lowest_deg: float
    highest_deg: float
    differs: bool
    """Whether it is far from the constant part of the whole."""


def map_difference(before: ReferenceLoop, after: ReferenceLoop) -> Difference | None:
    """Second minus first; None where they share too few angles in one direction, or one of them states nothing."""
    if before.not_traced or after.not_traced:
        return None
    maps = map_points(before.explanation), map_points(after.explanation)
    nodes = [_at_nodes(*maps, direction) for direction in _shared_directions(*maps)]
    points = [np.concatenate(column) for column in zip(*nodes, strict=True)] if nodes else []
    if not points or len(points[0]) < _FEWEST:
        return None
    angle_deg, direction, difference_deg, variance_deg2 = points
    numbers = direction.astype(np.int64)
    uncertainty_deg, freedom, basis = _uncertainty(maps, angle_deg, numbers, difference_deg, variance_deg2)
    return Difference(
        angle_deg=angle_deg,
        direction=numbers,
        difference_deg=difference_deg,
        uncertainty_deg=uncertainty_deg,
        degrees_of_freedom=freedom,
        basis=basis,
    )


def _shared_directions(first: MapPoints, second: MapPoints) -> list[int]:
    return [int(each) for each in np.intersect1d(first.direction, second.direction)]


def _at_nodes(first: MapPoints, second: MapPoints, direction: int) -> tuple[FloatArray, ...]:
    """Angles of the sparser of two maps with the difference there: angle, direction, difference, variance."""
    sides = first.side(direction), second.side(direction)
    sparse, dense, sign = (second, first, 1.0) if len(sides[1]) <= len(sides[0]) else (first, second, -1.0)
    own, other = (sides[1], sides[0]) if sign > 0 else sides
    at_deg = sparse.angle_deg[own]
    line = interpolated(dense, other, at_deg)
    own_variance = np.zeros(len(own)) if sparse.uncertainty_deg is None else sparse.uncertainty_deg[own] ** 2
    seen = line.seen
    return (
        at_deg[seen],
        np.full(int(seen.sum()), float(direction)),
        sign * (sparse.error_deg[own] - line.error_deg)[seen],
        (own_variance + line.variance_deg2)[seen],
    )


def _uncertainty(
    maps: tuple[MapPoints, MapPoints],
    angle_deg: FloatArray,
    direction: NDArray[np.int64],
    difference_deg: FloatArray,
    variance_deg2: FloatArray,
) -> tuple[FloatArray, int, str]:
    """Of each point, with its degrees of freedom, and where it comes from."""
    if all(each.uncertainty_deg is not None for each in maps) and bool(np.all(variance_deg2 > 0.0)):
        freedom = min(each.degrees_of_freedom for each in maps)
        return np.sqrt(variance_deg2), freedom, Message("the scatter of repeats, or of a stream what is left of it")
    beside = [
        beside_neighbours(angle_deg[direction == each], difference_deg[direction == each])
        for each in np.unique(direction)
    ]
    differences = np.concatenate(beside)
    deviation_deg = neighbours_deviation(differences)
    if not deviation_deg > 0.0:
        deviation_deg = max(float(np.std(difference_deg)), 1e-9)
    basis = Message(
        "the scatter of the difference beside its neighbours, as settings were not repeated: the weaker test"
    )
    return np.full(len(angle_deg), deviation_deg), max(2 * len(differences) // 3, 1), basis


def parts(difference: Difference) -> tuple[Part, ...]:
    """Where the difference is what: some parts of the arc by direction, or single settings where they are few."""
    return tuple(part for direction in np.unique(difference.direction) for part in _side(difference, int(direction)))


def _side(difference: Difference, direction: int) -> Iterator[Part]:
    chosen = np.flatnonzero(difference.direction == direction)
    count = len(chosen) if len(chosen) <= _FEW else _PARTS
    for rows in np.array_split(chosen, count):
        values = difference.difference_deg[rows]
        mean_deg = float(values.mean())
        own_deg = float(np.sqrt(np.sum(difference.uncertainty_deg[rows] ** 2))) / len(rows)
        yield Part(
            direction=direction,
            from_deg=float(difference.angle_deg[rows].min()),
            to_deg=float(difference.angle_deg[rows].max()),
            mean_deg=mean_deg,
            uncertainty_deg=own_deg,
            lowest_deg=float(values.min()),
            highest_deg=float(values.max()),
            differs=difference.varies and abs(mean_deg - difference.constant_deg) > _FAR * own_deg,
        )
