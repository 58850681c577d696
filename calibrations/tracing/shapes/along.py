"""A channel along a variable beside what was found: on this each shape is tried."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.calibrations.tracing.gains import Beside, Gained, best_column, gain_of_process, gains_of_pairs
from tumble.calibrations.tracing.spectrum import wave_squares, wave_sums
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Shape:
    """A shape that a channel could have along a variable, and what it explains."""

    name: str
    """A word, and the numbers that fix it."""
    described: Message
    """What it is, for a reader."""
    columns: Callable[[], FloatArray]
    """For a channel of one, shape (rows, n)."""
    gained: Gained
    tried: float
    """How many of its kind are tried."""
    whole: Callable[[], FloatArray] | None = None
    """The same as `columns` with what the declared model could as well be in it; None where that is all."""
    chance: float | None = None
    """At which one of its kind is there where there is nothing; None: its share of that of the axis."""


_DECLARED: Final = 1e-6
"""Part of a course that may be left beside the declared model where that has it."""


@dataclass(frozen=True, kw_only=True)
class Along:
    """A channel along a variable, beside what was found."""

    axis: Axis
    seen: Beside

    @property
    def coordinate(self) -> Coordinate:
        """The variable."""
        return self.axis.coordinate

    @property
    def rows(self) -> int:
        """Of the table."""
        return len(self.seen.root)

    @cached_property
    def level(self) -> FloatArray:
        """What a unit of the channel adds to the output, weighted, shape (rows,)."""
        return np.asarray(self.axis.channel.gain * self.seen.root)

    @cached_property
    def weighted(self) -> FloatArray:
        """What is taken, and what is left of the output, times that, shape (rows, n + 1)."""
        return np.column_stack([self.seen.taken, self.seen.left]) * self.level[:, None]

    @cached_property
    def falls_of_waves(self) -> FloatArray:
        """What each wave alone explains, of those with the coordinate's numbers of turns."""
        part, count = self.coordinate.part, len(self.coordinate.turns)
        sums = wave_sums(part, count, self.weighted)
        squares = wave_squares(part, count, self.level**2)
        return gains_of_pairs(self.seen.squares, self.rows, sums, squares)[0]

    def undetermined(self, course: FloatArray) -> FloatArray:
        """A course, shape (rows,), as a column if the declared model has it, so that no row shows it; else none."""
        weighted = course * self.level
        left = np.sum(weighted**2) - np.sum((self.seen.taken.T @ weighted) ** 2)
        return course[:, None] if left < _DECLARED * np.sum(weighted**2) else course[:, None][:, :0]

    def best_single(self, columns: FloatArray) -> tuple[int, Gained]:
        """Number and gain of the best of shapes of one column each."""
        weighted = columns * self.level[:, None]
        whole = np.sum(weighted**2, axis=0)
        left = whole - np.sum((self.seen.taken.T @ weighted) ** 2, axis=0)
        return best_column(left, whole, (self.seen.left @ weighted) ** 2, self.seen.squares, self.rows)

    def best_pair(self, pair: tuple[FloatArray, FloatArray]) -> tuple[int, Gained]:
        """The same of shapes of two columns each, given as all the first and all the second ones."""
        return highest(*self.pairs(pair))

    def pairs(self, pair: tuple[FloatArray, FloatArray]) -> tuple[FloatArray, FloatArray]:
        """Fall and variance of each of them."""
        (first, second), square = pair, self.level**2
        sums = (self.weighted.T @ first, self.weighted.T @ second)
        products = (square @ first**2, square @ second**2, square @ (first * second))
        return gains_of_pairs(self.seen.squares, self.rows, sums, products)

    def together(self, columns: FloatArray) -> Gained:
        """What columns gain together, with coefficients of one variance."""
        weighted = columns * self.level[:, None]
        taken, scale = self.seen.taken.T @ weighted, float(np.sum(weighted**2)) / self.rows or 1.0
        gram = (weighted.T @ weighted - taken.T @ taken) / scale
        return gain_of_process(gram, (self.seen.left @ weighted) / np.sqrt(scale), self.seen.squares, self.rows)

    def shown(self, part: float) -> str:
        """The value at a part of the range, for a reader."""
        return self.coordinate.shown(float(self.coordinate.low + self.coordinate.range * part))


def highest(falls: FloatArray, variances: FloatArray) -> tuple[int, Gained]:
    """Number and gain of the largest fall."""
    best = int(np.argmax(falls))
    return best, (float(falls[best]), float(variances[best]))


def sides(pair: Sequence[FloatArray], number: int) -> FloatArray:
    """The column of that number of each side."""
    return np.column_stack([side[:, number] for side in pair])


def named(word: str, numbers: Sequence[float]) -> str:
    """A word, and the numbers that fix it."""
    return " ".join([word, *(f"{number:.8g}" for number in numbers)])


def beside(undetermined: FloatArray, columns: Callable[[], FloatArray]) -> Callable[[], FloatArray]:
    """Columns of a shape with those that no row shows, for its `whole`."""
    return lambda: np.column_stack([columns(), undetermined])
