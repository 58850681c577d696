"""A variable on which structure without a name may depend, and the shapes that are tried along it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.bins import cells, distances, root
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.spectrum import TURNS_APART
from tumble.messages import Message

MOST_VALUES: Final = 90
"""Variables with more distinct values are cut into so many bins of equally many rows."""
_DWELLS_EACH: Final = 3
"""So many dwells each bin has at least, in the mean."""
_ROUGH: Final = (0.03, 0.3, 3.0)
"""Lengths of the exponential kernel, in ranges of the variable: broken courses."""
_SMOOTH: Final = (0.017, 0.05, 0.15, 0.5, 1.5)
"""Lengths of the squared exponential kernel: smooth courses."""
_WIDTHS: Final = (0.02, 0.04, 0.08, 0.16)
"""Widths of bumps, in ranges of the variable."""
_WIDEST: Final = 0.3
_STEPS_OF_WIDTH: Final = 13
_SPOTS: Final = (0.1, 0.2, 0.4)
"""Widths of spots in space, in parts of the longest side of the room."""
IntArray = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Coordinate:
    """A variable on which a channel may depend."""

    word: str
    """Of the contract, as `angle` or `time_since_seating`."""
    depends_on: Variable
    values: FloatArray
    """Shape (rows,), or (rows, n) where it is a place in space."""
    phrase: Message
    """What it follows, for a reader: `that follows the time`."""
    shown: Callable[[float], str] = "{:.3g}".format
    """A value of it, for a reader."""
    period: float | None = None
    """Of a variable that comes back on itself."""
    ordered: bool = True
    """Whether neighbouring values are alike; of labels they are not."""
    waves: bool = False
    """Whether something may swing along it, up to the Nyquist limit of its values."""
    steps: bool = False
    """Whether something may step along it."""
    overtones: bool = False
    """Whether something may come again along it in a shape that is no sine."""
    kinks: bool = False
    """Whether its slope may change from one value to the next."""
    onsets: bool = False
    """Whether something may begin along it and settle, or change to and fro."""
    bumps: bool = False
    """Whether something may be at one place of it only."""
    detail: str = ""
    """Which of several variables of the same word it is: `ax` of the acceleration."""
    unit: str = ""
    """Of its values; empty where they count or are labels."""
    outputs: int = 1
    """Rows of one dwell, which share its value: one for each output that a method takes together."""
    recurs: bool = True
    """Whether a value means the same in another run; the number of a realisation does not."""

    @cached_property
    def bins(self) -> IntArray:
        """Number of the value of each row, or of the bin that it is in: never many beside the rows.

        With a number of its own for nearly every row, nothing would be left to tell a course from the noise of a dwell.
        """
        rows = len(self.values)
        most = min(MOST_VALUES, rows // (_DWELLS_EACH * self.outputs))
        if self.values.ndim > 1:
            return cells(self.values, most)
        distinct, number = np.unique(np.round(self.values, 6), return_inverse=True)
        if len(distinct) <= most or not self.ordered:
            return np.asarray(number, dtype=np.int64)
        rank = np.argsort(np.argsort(self.values, kind="stable"), kind="stable")
        return np.asarray(rank * most // rows, dtype=np.int64)

    @property
    def fewest_rows(self) -> int:
        """What is at one place, or lasts, in fewer rows than this could be gross errors."""
        return _FEWEST * self.outputs

    @property
    def bends_tried(self) -> bool:
        """Whether polynomials of it make sense."""
        return self.ordered and self.period is None and self.values.ndim == 1

    @property
    def varies(self) -> bool:
        """Whether there is anything to follow."""
        return bool(self.bins.max(initial=0) > 0)

    @cached_property
    def centres(self) -> FloatArray:
        """Mean value of each bin, shape (bins, 1 or n)."""
        values = self.values.reshape(len(self.values), -1)
        count = np.bincount(self.bins)[:, None]
        sums = np.stack([np.bincount(self.bins, column) for column in values.T], axis=1)
        return np.asarray(sums / count)

    @cached_property
    def courses(self) -> tuple[tuple[str, FloatArray], ...]:
        """Square roots of the kernels over the bins, shape (bins, directions), each with the word for it."""
        if not self.ordered:
            return (("levels", np.eye(int(self.bins.max()) + 1)),)
        away = distances(self.centres, self.period)
        rough = [(f"broken {length:g}", np.exp(-away / length)) for length in _ROUGH]
        smooth = [(f"smooth {length:g}", np.exp(-0.5 * (away / length) ** 2)) for length in _SMOOTH]
        return tuple((word, root(kernel)) for word, kernel in (*rough, *smooth))

    @cached_property
    def turns(self) -> FloatArray:
        """Numbers of turns over the range, up to half of one for each typical distance between neighbours."""
        return TURNS_APART * np.arange(1, self.nyquist_turns / TURNS_APART)

    @cached_property
    def nyquist_turns(self) -> float:
        """Turns over the range that are half of one for each typical distance between neighbours."""
        apart = np.diff(np.unique(np.round(self.part, 9)))
        return _NYQUIST * min(0.5 / float(np.median(apart)), len(self.part) / 2) if len(apart) else 0.0

    def swung(self, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Sines and cosines of waves with so many turns over the range, shape (rows, waves)."""
        phase = 2.0 * np.pi * np.outer(self.part, turns)
        return np.sin(phase), np.cos(phase)

    @cached_property
    def bumps_tried(self) -> FloatArray:
        """Centre and width of every bump that is tried, shape (bumps, 2)."""
        return np.concatenate([self.bumps_of(width * self.cycle) for width in _WIDTHS])

    def bumps_of(self, width: float) -> FloatArray:
        """Those of one width, so far apart, shape (bumps, 2)."""
        centres = np.arange(self.low, self.low + self.cycle, width)
        return self._several_rows(np.column_stack([centres, np.full(len(centres), width)]))

    @property
    def widths(self) -> FloatArray:
        """Widths that a bump could have where a few places do not tell it, in steps of a fourth."""
        return np.asarray(self.cycle * np.geomspace(_WIDTHS[0], _WIDEST, _STEPS_OF_WIDTH))

    def bumps_near(self, centre: float, width: float) -> FloatArray:
        """The same closer about one of them."""
        tried = [(centre + part * width, width * ratio) for part in _PARTS for ratio in _TIMES]
        return self._several_rows(np.array(tried))

    def bumps_beside(self, centre: float, width: float) -> FloatArray:
        """One of them, and the same a little to each side."""
        tried = [(centre + part * width, width) for part in _PARTS]
        return self._several_rows(np.array(tried))

    def bells(self, bumps: FloatArray) -> tuple[FloatArray, FloatArray]:
        """A bell for each bump, and its slope, shape (rows, bumps)."""
        away = self.values[:, None] - bumps[:, 0]
        if self.period is not None:
            away = (away + self.period / 2) % self.period - self.period / 2
        away = away / bumps[:, 1]
        bell = np.exp(-0.5 * away**2)
        return np.asarray(bell), np.asarray(away * bell)

    @cached_property
    def bells_tried(self) -> tuple[FloatArray, FloatArray]:
        """The same for every bump that is tried."""
        return self.bells(self.bumps_tried)

    @cached_property
    def spots_tried(self) -> FloatArray:
        """Centre and width of every spot in space that is tried, shape (spots, n + 1)."""
        away = float(np.ptp(self.centres, axis=0).max())
        tried = np.concatenate(
            [np.column_stack([self.centres, np.full(len(self.centres), away * width)]) for width in _SPOTS]
        )
        return self._spots_of_several_rows(tried)

    def spots(self, spots: FloatArray) -> FloatArray:
        """A bell about each of some places in space, shape (rows, spots)."""
        away = np.linalg.norm(self.values[:, None, :] - spots[:, :-1], axis=-1) / spots[:, -1]
        return np.asarray(np.exp(-0.5 * away**2))

    def spots_near(self, spot: FloatArray) -> FloatArray:
        """One of them, and the same a part of its width to each side, narrower and wider, shape (spots, n + 1)."""
        away = np.concatenate([np.zeros((1, len(spot) - 1)), *(step * np.eye(len(spot) - 1) for step in _ASIDE)])
        near = [(*(spot[:-1] + spot[-1] * each), spot[-1] * ratio) for each in away for ratio in _TIMES]
        return self._spots_of_several_rows(np.array(near))

    def _spots_of_several_rows(self, spots: FloatArray) -> FloatArray:
        """Those in whose middle are several rows."""
        return np.asarray(spots[np.count_nonzero(self.spots(spots) > _MIDDLE, axis=0) >= self.fewest_rows])

    def _several_rows(self, bumps: FloatArray) -> FloatArray:
        """Those in whose middle are several rows."""
        bell, _ = self.bells(bumps)
        return np.asarray(bumps[np.count_nonzero(bell > _MIDDLE, axis=0) >= self.fewest_rows])

    @cached_property
    def bends(self) -> FloatArray:
        """Chebyshev's polynomials over the range that bend, shape (rows, polynomials)."""
        return self.polynomials[:, _STRAIGHT:]

    @cached_property
    def polynomials(self) -> FloatArray:
        """The same with those that do not."""
        return np.asarray(np.polynomial.chebyshev.chebvander(2.0 * self.part - 1.0, _MOST_BENT))

    @cached_property
    def places(self) -> FloatArray:
        """Where steps are tried, as parts of the range: between any two rows, or between so many of them."""
        between = np.unique(self.part)
        between = (between[1:] + between[:-1]) / 2.0
        return np.asarray(between[np.unique(np.linspace(0, len(between) - 1, _STEPS).round().astype(int))])

    def nearby(self, place: float) -> FloatArray:
        """Every place between two rows that is nearer to one of the places than the next of them."""
        between = np.unique(self.part)
        between = (between[1:] + between[:-1]) / 2.0
        number = int(np.searchsorted(self.places, place))
        low, high = self.places[max(number - 1, 0)], self.places[min(number + 1, len(self.places) - 1)]
        return np.asarray(between[(between >= low) & (between <= high)])

    @cached_property
    def _rising(self) -> IntArray:
        """Numbers of the rows in the order of their values."""
        return np.argsort(self.part, kind="stable")

    def rows_before(self, places: FloatArray) -> IntArray:
        """How many rows are before each of the places."""
        return np.searchsorted(self.part[self._rising], places, side="right")

    def sums_after(self, places: FloatArray, columns: FloatArray) -> FloatArray:
        """Products of columns, shape (rows, n), with a step at each of the places: sums of the rows after it."""
        sums = np.cumsum(columns[self._rising[::-1]], axis=0)[::-1]
        return np.asarray(sums[self.rows_before(places)])

    def stepped(self, places: FloatArray) -> FloatArray:
        """A step at each of the places, shape (rows, places)."""
        return (self.part[:, None] > places).astype(float)

    def between(self, ends: FloatArray) -> FloatArray:
        """1 after the one end, or between the two, 0 elsewhere, shape (rows,)."""
        steps = self.stepped(ends)
        return np.asarray(steps[:, 0] - (steps[:, 1] if len(ends) > 1 else 0.0))

    def on_the_shorter_arc(self, ends: FloatArray, between: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The ends and the same; of a circle the shorter arc: what is off is the smaller part of it."""
        arc = (ends[1] if len(ends) > 1 else 1.0) - ends[0]
        if self.period is None or arc * self.range <= self.period / 2:
            return ends, between
        return ends[::-1], 1.0 - between

    @property
    def low(self) -> float:
        """Its lowest value."""
        return float(self.values.min())

    @property
    def range(self) -> float:
        """Its highest value less its lowest."""
        return float(np.ptp(self.values))

    @cached_property
    def part(self) -> FloatArray:
        """Where each row is in the range of the variable, from 0 to 1."""
        return np.asarray((self.values - self.values.min()) / np.ptp(self.values))

    @property
    def cycle(self) -> float:
        """After so much of the variable a wave of one turn comes again."""
        return self.period or self.range

    @cached_property
    def part_of_cycle(self) -> FloatArray:
        """Where each row is in it."""
        return np.asarray((self.values - self.low) / self.cycle)


_PARTS: Final = (-0.6, -0.3, 0.0, 0.3, 0.6)
_ASIDE: Final = (-0.4, 0.4)
_TIMES: Final = (0.6, 0.8, 1.0, 1.25, 1.6)
_STRAIGHT: Final = 2
"""A constant and a straight line are no bends."""
_MOST_BENT: Final = 5
"""Order of the highest polynomial that is tried."""
_MIDDLE: Final = 0.6
_FEWEST: Final = 4
"""So many dwells are more than a few gross errors."""
_STEPS: Final = 120
"""Places at which a step is tried."""
_NYQUIST: Final = 0.98
"""At the limit itself one phase of a wave is nothing."""
