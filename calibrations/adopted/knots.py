"""The variable that an adopted effect follows, cut into knots between which its course is a straight line."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.coordinate import Coordinate

_ROUND: Final = 72
"""Knots of a variable that comes back on itself: every 5° of a turn."""
_ALONG: Final = 48
"""Knots of any other."""
_MARGIN: Final = 0.02
"""By this part of the range a value may lie beyond what was measured: there the course stays what it was at the end."""
_CELL: Final = 0.15
"""Places in space closer than this are one knot."""
_MOST_CELLS: Final = 64
_ROUGH: Final = (0.03, 0.3, 3.0)
_SMOOTH: Final = (0.05, 0.15, 0.5, 1.5)
"""Lengths of the exponential and of the squared exponential kernel, in ranges of the variable."""
_KEPT: Final = 1e-6
"""Directions in which a course varies by less than this part of its largest variance are left out."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """Values of a variable at which a course is known."""

    places: FloatArray
    """Shape (knots, 1), or (knots, n) where the variable is a place in space; along a line, rising."""
    period: float | None = None
    """Of a variable that comes back on itself; its knots are spread evenly over it."""
    ordered: bool = True
    """Whether neighbouring values are alike; of labels they are not."""

    @property
    def on_a_line(self) -> bool:
        """Whether there is a straight line between two neighbours."""
        return self.ordered and self.places.shape[1] == 1

    def beyond(self, values: FloatArray) -> NDArray[np.bool_]:
        """Whether each value lies where nothing is known, shape (rows,)."""
        if self.period is not None:
            return np.zeros(len(values), dtype=bool)
        if not self.on_a_line:
            return np.asarray(self._nearest(values)[1] > (_CELL if self.ordered else 0.0))
        low, high = self.places[0, 0], self.places[-1, 0]
        margin = _MARGIN * (high - low)
        return np.asarray((values < low - margin) | (values > high + margin))

    def basis(self, values: FloatArray) -> FloatArray:
        """Part of each knot in what the course is at each value, shape (rows, knots)."""
        rows, count = np.arange(len(values)), len(self.places)
        basis = np.zeros((len(values), count))
        if not self.on_a_line:
            basis[rows, self._nearest(values)[0]] = 1.0
            return basis
        if self.period is not None:
            place = values % self.period / self.period * count
            before = np.floor(place).astype(int)
            after, part = (before + 1) % count, place - before
            before = before % count
        else:
            line = self.places[:, 0]
            within = np.clip(values, line[0], line[-1])
            before = np.clip(np.searchsorted(line, within, side="right") - 1, 0, count - 2)
            after, part = before + 1, (within - line[before]) / (line[before + 1] - line[before])
        basis[rows, before] += 1.0 - part
        basis[rows, after] += part
        return basis

    @cached_property
    def courses(self) -> tuple[tuple[str, FloatArray], ...]:
        """Square roots of the kernels of a course over the knots, shape (knots, directions), each with its word."""
        if not self.ordered:
            return (("levels", np.eye(len(self.places))),)
        away = self._distances
        rough = [(f"broken {length:g}", np.exp(-away / length)) for length in _ROUGH]
        smooth = [(f"smooth {length:g}", np.exp(-0.5 * (away / length) ** 2)) for length in _SMOOTH]
        return tuple((word, _root(kernel)) for word, kernel in (*rough, *smooth))

    @property
    def _distances(self) -> FloatArray:
        """Between knots, in ranges of the variable; round a circle, half its circumference is the range."""
        apart = self.places[:, None, :] - self.places[None, :, :]
        if self.period is not None:
            return np.asarray(np.abs(np.sin(np.pi * apart[..., 0] / self.period)))
        away = np.linalg.norm(apart, axis=-1)
        return np.asarray(away / away.max())

    def _nearest(self, values: FloatArray) -> tuple[NDArray[np.int64], FloatArray]:
        """Number of the nearest knot of each value, and how far off it is."""
        away = np.linalg.norm(values.reshape(len(values), 1, -1) - self.places, axis=-1)
        nearest = np.argmin(away, axis=1)
        return nearest, np.asarray(away[np.arange(len(values)), nearest])


def knots_of(coordinates: Sequence[Coordinate]) -> Knots:
    """Knots over all that several tables show of one variable."""
    first = coordinates[0]
    values = np.concatenate([each.values for each in coordinates])
    if values.ndim > 1:
        return Knots(places=_cells(values))
    if not first.ordered:
        return Knots(places=np.unique(values)[:, None], ordered=False)
    if first.period is not None:
        return Knots(places=np.arange(_ROUND)[:, None] * first.period / _ROUND, period=first.period)
    return Knots(places=np.linspace(values.min(), values.max(), _ALONG)[:, None])


def _cells(values: FloatArray) -> FloatArray:
    """Mean places of the cells that hold any value, the cells as small as so many of them allow."""
    cell = _CELL
    while True:
        distinct, number = np.unique(np.round(values / cell), axis=0, return_inverse=True)
        if len(distinct) <= _MOST_CELLS:
            count = np.bincount(number.ravel())[:, None]
            return np.stack([np.bincount(number.ravel(), column) for column in values.T], axis=1) / count
        cell *= 1.5


def _root(kernel: FloatArray) -> FloatArray:
    values, vectors = np.linalg.eigh(kernel)
    kept = values > _KEPT * values[-1]
    return np.asarray(vectors[:, kept] * np.sqrt(values[kept]))
