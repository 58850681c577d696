"""Autocorrelated noise, beside white noise: flicker, random walk, and random effects of every seat or turn-on.

A mean-free random walk is a sum of cosines with variances falling as 1/k² (Karhunen-Loève expansion of the centred
Wiener process), flicker one with variances falling as 1/k (power spectral density h/f). What the modes do not reach is
white to the eye of a dwell. Levels (seating, turn-on bias) are columns with independent coefficients of one variance.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message

MODES = 100
WALK = Message.named("bias_random_walk", "random walk of the bias")
"""The effect that a walk is; a method may call it otherwise in its results."""
_NOTHING = 1e-12
"""Part of a direction's variance below which noise leaves it as it is."""
_DEPENDENT = 1e-7
"""A level, of length one in a row, of which less is left beside the others lies along them."""
SETTINGS = "?setting"
"""Levels by which settings differ from the model in no shape at all: lack of fit, as a noise that repeats share."""


@dataclass(frozen=True, kw_only=True)
class NoiseModel:
    """Variances relative to the variance of a dwell."""

    flicker: float = 0.0
    """Of the first mode."""
    walk: float = 0.0
    """Of the first mode."""
    levels: tuple[tuple[str, float], ...] = ()
    """Mean variance of a row by the levels of each effect, by name."""

    @property
    def white(self) -> bool:
        """Whether there is nothing but white noise."""
        return self.flicker == 0.0 and self.walk == 0.0 and not self.levels

    def with_level(self, name: str, variance: float) -> "NoiseModel":
        """The same with the levels of an effect."""
        return replace(self, levels=(*self.without(name).levels, (name, variance)))

    def without(self, name: str) -> "NoiseModel":
        """The same without the levels of an effect."""
        return replace(self, levels=tuple(level for level in self.levels if level[0] != name))


WHITE = NoiseModel()


@dataclass(frozen=True, kw_only=True)
class Whitening:
    """A symmetric linear transformation after which the noise is white."""

    directions: FloatArray
    """Orthonormal, shape (rows, n)."""
    covariance: FloatArray
    """Of the noise along the first m of them, in units of the variance of a dwell, shape (m, m); one along the rest."""

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Transform columns, shape (rows, n) or (rows,)."""
        along = self.directions[:, : len(self._shrink)]
        return np.asarray(columns - along @ (self._shrink @ (along.T @ columns)))

    @cached_property
    def log_determinant(self) -> float:
        """Logarithm of the determinant of the covariance."""
        return 2.0 * float(np.sum(np.log(np.diag(self._factor))))

    @cached_property
    def taken(self) -> FloatArray:
        """Columns T, shape (rows, m), with the square of the transformation 1 - TT'."""
        values, vectors = self._spectrum
        part = values / (1.0 + values)
        kept = part > _NOTHING
        return np.asarray(self.directions[:, : len(values)] @ (vectors[:, kept] * np.sqrt(part[kept])))

    def turned(self, columns: FloatArray) -> FloatArray:
        """Transform columns that `Memory.turned` has turned: the same lengths and angles, in other directions."""
        from scipy.linalg.lapack import dtrtrs

        size = len(self.covariance)
        if not size or not columns.size:
            return columns
        return np.concatenate([dtrtrs(self._factor, columns[:size], lower=1)[0], columns[size:]])

    @cached_property
    def _factor(self) -> FloatArray:
        """Lower triangular, by Cholesky: a tenth of the work of the spectrum."""
        return np.asarray(np.linalg.cholesky(self.covariance))

    @cached_property
    def _spectrum(self) -> tuple[FloatArray, FloatArray]:
        """Variances beyond that of a dwell along the axes of the covariance, and these."""
        values, vectors = np.linalg.eigh(self.covariance - np.eye(len(self.covariance)))
        return np.clip(values, 0.0, None), np.asarray(vectors)

    @cached_property
    def _shrink(self) -> FloatArray:
        """By how much what lies along the first directions is changed."""
        values, vectors = self._spectrum
        return np.asarray((vectors * (1.0 - 1.0 / np.sqrt(1.0 + values))) @ vectors.T)


@dataclass(frozen=True, kw_only=True)
class Memory:
    """Everything in a table along which noise can be correlated over."""

    modes: FloatArray
    """A constant and cosines over the run, weighted, shape (rows, 1 + modes); no columns where there is no time."""
    levels: Mapping[str, FloatArray] = field(default_factory=dict)
    """Columns of each effect that draws levels, weighted and scaled to a mean square of one row, by name."""
    before: "Memory | None" = None
    """The same without its last levels, whose directions are kept; None where it was made at once."""

    @cached_property
    def _whitenings(self) -> dict[NoiseModel, Whitening]:
        return {}

    @cached_property
    def _factors(self) -> tuple[FloatArray, FloatArray]:
        """Orthonormal directions of modes and levels, and both along them."""
        if self.before is None:
            factored = np.linalg.qr(np.column_stack([self.modes, *self.levels.values()]))
            return factored.Q, factored.R
        known, along = self.before._factors
        added = np.column_stack([level for name, level in self.levels.items() if name not in self.before.levels])
        shown, left = _parted(known, added)
        further, beside = _independent(left)
        nothing = np.zeros((len(beside), along.shape[1]))
        return np.column_stack([known, further]), np.block([[along, shown], [nothing, beside]])

    def with_levels(self, levels: Mapping[str, FloatArray]) -> "Memory":
        """The same with the levels of further effects."""
        if not levels:
            return self
        if self.levels.keys() & levels.keys():
            return Memory(modes=self.modes, levels={**self.levels, **levels})
        return Memory(modes=self.modes, levels={**self.levels, **levels}, before=self)

    def within(self, noise: NoiseModel) -> "Memory":
        """What of it a noise draws: all that is needed where no other is asked about."""
        drawn = dict(noise.levels)
        return Memory(
            modes=self.modes if noise.flicker or noise.walk else self.modes[:, :0],
            levels={name: level for name, level in self.levels.items() if name in drawn},
        )

    def rows(self, kept: NDArray[np.bool_]) -> "Memory":
        """The same for some of the rows."""
        return Memory(modes=self.modes[kept], levels={name: level[kept] for name, level in self.levels.items()})

    def turned(self, columns: FloatArray) -> FloatArray:
        """Weighted columns, shape (rows, n), what noise is correlated over apart from the rest: (more rows, n).

        First what lies along the directions of the memory, one row for each, then what lies beside them. Lengths and
        angles stay as they are, and whatever the noise, only the first rows change when it is made white.
        """
        directions, _ = self._factors
        if not directions.shape[1]:
            return columns
        along = directions.T @ columns
        return np.concatenate([along, columns - directions @ along])

    @property
    def size(self) -> int:
        """How many rows of turned columns lie along the memory."""
        return int(self._factors[0].shape[1])

    def drawn(self, noise: NoiseModel) -> FloatArray:
        """Columns whose coefficients are independent draws of the variance of a dwell, weighted, shape (rows, n)."""
        variances = self._variances(noise)
        along = np.column_stack([self.modes, *self.levels.values()])
        return np.asarray(along[:, variances > 0] * np.sqrt(variances[variances > 0]))

    def whitening(self, noise: NoiseModel) -> Whitening:
        """The transformation for a noise model; the identity for white noise."""
        if noise not in self._whitenings:
            self._whitenings[noise] = self._whitening(noise)
        return self._whitenings[noise]

    def _whitening(self, noise: NoiseModel) -> Whitening:
        directions, triangular = self._factors
        variances = self._variances(noise)
        if not variances.any():
            return Whitening(directions=directions, covariance=np.empty((0, 0)))
        size = min(int(np.flatnonzero(variances)[-1]) + 1, len(triangular))
        seen = triangular[:size, variances > 0]
        return Whitening(directions=directions, covariance=np.eye(size) + (seen * variances[variances > 0]) @ seen.T)

    def _variances(self, noise: NoiseModel) -> FloatArray:
        """Of every mode and every level."""
        order = np.arange(1, self.modes.shape[1])
        waves = noise.flicker / order + noise.walk / order**2
        drawn = dict(noise.levels)
        levels = [np.full(level.shape[1], drawn.get(name, 0.0)) for name, level in self.levels.items()]
        constant = [noise.flicker * np.log(2.0)] * min(self.modes.shape[1], 1)
        return np.concatenate([constant, waves, *levels])


def _parted(directions: FloatArray, columns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Columns along orthonormal directions, and what is left of them, orthogonal to rounding."""
    along = directions.T @ columns
    left = columns - directions @ along
    again = directions.T @ left
    return along + again, left - directions @ again


def _independent(columns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Orthonormal directions of columns, shape (rows, rank), and the columns along them."""
    from scipy.linalg import qr

    directions, triangular, order = qr(columns, mode="economic", pivoting=True)
    size = np.abs(np.diag(triangular))
    rank = int(np.count_nonzero(size > _DEPENDENT))
    along = np.empty_like(triangular[:rank])
    along[:, order] = triangular[:rank]
    return np.asarray(directions[:, :rank]), np.asarray(along)


def slow_modes(hours: FloatArray | None, weights: FloatArray, part: float = 0.25) -> FloatArray:
    """A constant and cosines over the run, weighted, shape (rows, 1 + modes); none without time or with few rows.

    The constant is what flicker slower than the run leaves: of the octave below, the power is h ln 2. There are `part`
    as many cosines as rows: more of them where the declared model follows the slowest ones.
    """
    rows = len(weights)
    count = min(MODES, int(part * rows))
    if hours is None or count < 4 or np.ptp(hours) <= 0:
        return np.empty((rows, 0))
    phase = np.pi * (hours - hours.min()) / np.ptp(hours)
    cosines = np.sqrt(2.0) * np.cos(np.outer(phase, np.arange(1, count + 1)))
    return np.column_stack([np.ones(rows), cosines]) * np.sqrt(weights)[:, None]


def scaled_levels(columns: FloatArray, weights: FloatArray, by: FloatArray | None = None) -> FloatArray:
    """Weighted level columns, scaled to a mean square of one row; or by what so scales other columns, `by`."""
    root = np.sqrt(weights)[:, None]
    measured = (columns if by is None else by) * root
    return np.asarray(columns * root / np.sqrt(np.mean(np.sum(measured**2, axis=1))))
