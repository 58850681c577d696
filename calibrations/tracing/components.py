"""Structure without a name as variance components: a channel of the model that follows a variable along no given shape.

A component is c(row) · f(v(row)): c is what a unit of the channel adds to the output, v the variable, and f a zero-mean
Gaussian process over the distinct values of v (Rasmussen and Williams, Gaussian Processes for Machine Learning, 4.2), a
wave of any phase, or a step. All are the same thing to a fit: columns whose coefficients are independent draws of one
variance. The method declares its channels and variables; which of them a table shows is found in `scan`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.effect import Variable
from tumble.messages import Message

MARK: Final = "?"
"""With it begins the name of what is noise to a fit and no effect: levels of settings, components."""
MOST_VALUES: Final = 90
"""Variables with more distinct values are cut into so many bins of equally many rows."""
_KEPT: Final = 1e-3
"""Directions in which a process varies by less than this part of its largest are left out."""
_ROUGH: Final = (0.03, 0.3, 3.0)
"""Lengths of the exponential kernel, in ranges of the variable: broken courses."""
_SMOOTH: Final = (0.15, 0.5, 2.0)
"""Lengths of the Matérn kernel of order 3/2: smooth courses."""
IntArray = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Channel:
    """What of the model changes."""

    word: str
    """Of the contract: offset, scale or angle."""
    gain: FloatArray
    """What one unit of it adds to the output, shape (rows,)."""
    phrase: Message
    """What changes, for a reader."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Coordinate:
    """A variable on which a channel may depend."""

    word: str
    """Of the contract, as `angle` or `time_since_seating`."""
    depends_on: Variable
    values: FloatArray
    """Shape (rows,), or (rows, n) where it is a place in space."""
    phrase: Message
    """With what a channel changes, for a reader."""
    period: float | None = None
    """Of a variable that comes back on itself."""
    ordered: bool = True
    """Whether neighbouring values are alike; of labels they are not."""
    waves: bool = False
    """Whether something may swing along it, up to the Nyquist limit of its values."""
    steps: bool = False
    """Whether something may step along it."""

    @cached_property
    def bins(self) -> IntArray:
        """Number of the value of each row, or of the bin that it is in."""
        if self.values.ndim > 1:
            _, number = np.unique(np.round(self.values / _CELL), axis=0, return_inverse=True)
            return np.asarray(number, dtype=np.int64).ravel()
        distinct, number = np.unique(np.round(self.values, 6), return_inverse=True)
        if len(distinct) <= MOST_VALUES:
            return np.asarray(number, dtype=np.int64)
        rank = np.argsort(np.argsort(self.values, kind="stable"), kind="stable")
        return np.asarray(rank * MOST_VALUES // len(rank), dtype=np.int64)

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
        away = _distances(self.centres, self.period)
        rough = [(f"course {length:g}", np.exp(-away / length)) for length in _ROUGH]
        smooth = [(f"smooth course {length:g}", _matern(away / length)) for length in _SMOOTH]
        return tuple((word, _root(kernel)) for word, kernel in (*rough, *smooth))

    @cached_property
    def turns(self) -> FloatArray:
        """Numbers of turns over the range, up to half of one for each typical distance between neighbours."""
        apart = np.diff(np.unique(np.round(self._part, 9)))
        limit = min(0.5 / float(np.median(apart)), len(self._part) / 2) if len(apart) else 0.0
        return np.arange(_TURNS_APART, limit, _TURNS_APART)

    @cached_property
    def swing(self) -> tuple[FloatArray, FloatArray]:
        """Sines and cosines of waves with those turns, shape (rows, waves)."""
        phase = 2.0 * np.pi * np.outer(self._part, self.turns)
        return np.sin(phase), np.cos(phase)

    @cached_property
    def stepping(self) -> tuple[FloatArray, FloatArray]:
        """Places of steps as parts of the range, and a column for each, shape (rows, steps)."""
        places = np.linspace(0.01, 0.99, _STEPS)
        return places, (self._part[:, None] > places).astype(float)

    @cached_property
    def _part(self) -> FloatArray:
        """Where each row is in the range of the variable, from 0 to 1."""
        return np.asarray((self.values - self.values.min()) / np.ptp(self.values))


_STEPS: Final = 150
"""Places at which a step is tried."""
_TURNS_APART: Final = 0.5
"""Waves are tried so many turns over the range apart: half of what parts two of them."""
_CELL: Final = 0.15
"""Places closer than this are one."""


def _distances(centres: FloatArray, period: float | None) -> FloatArray:
    """Distances between bins in ranges of the variable; round a circle, half its circumference is the range."""
    apart = centres[:, None, :] - centres[None, :, :]
    if period is not None:
        return np.asarray(np.abs(2.0 * np.sin(np.pi * apart[..., 0] / period)) / 2.0)
    away = np.linalg.norm(apart, axis=-1)
    return np.asarray(away / max(float(away.max()), 1e-300))


def _matern(distance: FloatArray) -> FloatArray:
    scaled = np.sqrt(3.0) * distance
    return np.asarray((1.0 + scaled) * np.exp(-scaled))


def _root(kernel: FloatArray) -> FloatArray:
    values, vectors = np.linalg.eigh(kernel)
    kept = values > _KEPT * values[-1]
    return np.asarray(vectors[:, kept] * np.sqrt(values[kept]))


@dataclass(frozen=True, kw_only=True, eq=False)
class Component:
    """Structure without a name: its columns have independent coefficients of one variance."""

    channel: Channel
    coordinate: Coordinate
    shape: str
    columns: FloatArray
    """Shape (rows, n)."""
    penalty: float
    """By how much -2 ln L must fall for it to be believed, everything that is tried counted."""
    described: Message
    """What it is, for a reader."""

    @property
    def name(self) -> str:
        """No other component of the table has it."""
        return f"{MARK}{self.channel.word} {self.coordinate.phrase} {self.shape}"

    @property
    def place(self) -> tuple[str, str]:
        """Channel and variable, as the contract calls them."""
        return self.channel.word, self.coordinate.word

    @property
    def depends_on(self) -> Variable:
        """What it depends on."""
        return self.coordinate.depends_on


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A channel and a variable that it may follow."""

    channel: Channel
    coordinate: Coordinate


def axes(*pairs: tuple[Channel, tuple[Coordinate, ...]]) -> tuple[Axis, ...]:
    """Every channel with every variable of its list that varies in the table."""
    return tuple(_axes(pairs))


def _axes(pairs: tuple[tuple[Channel, tuple[Coordinate, ...]], ...]) -> Iterator[Axis]:
    for channel, coordinates in pairs:
        for coordinate in coordinates:
            if coordinate.varies and np.ptp(coordinate.values, axis=0).any() and channel.gain.any():
                yield Axis(channel=channel, coordinate=coordinate)


def penalty(chance: float) -> float:
    """Fall of -2 ln L that a variance without meaning reaches with this chance.

    A variance is at its bound where there is nothing: half the chance of chi-square with one degree of freedom (Self
    and Liang 1987).
    """
    return float(chi2.isf(min(2.0 * chance, 1.0), 1))
