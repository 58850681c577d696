"""Noise that remembers, beside white noise: flicker, random walk, and levels drawn anew at every seat or turn-on.

A mean-free random walk is a sum of cosines with variances falling as 1/k² (Karhunen-Loève expansion of the centred
Wiener process), flicker one with variances falling as 1/k (power spectral density h/f). A walk with a corner is pulled
back to its mean (Ornstein and Uhlenbeck). What the modes do not reach is white to the eye of a dwell. Levels (seating,
turn-on bias) are columns with independent coefficients of one variance.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from calibrations.geometry import FloatArray

MODES = 100


@dataclass(frozen=True, kw_only=True)
class NoiseModel:
    """Variances relative to the variance of a dwell."""

    flicker: float = 0.0
    """Of the first mode."""
    walk: float = 0.0
    """Of a walk without corner, the first mode."""
    corner: float = 0.0
    """Mode below which the walk is pulled back to its mean (Ornstein and Uhlenbeck); 0: it never is."""
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


@dataclass(frozen=True, kw_only=True)
class Whitening:
    """A symmetric linear transformation after which the noise is white."""

    directions: FloatArray
    """Orthonormal, shape (rows, n)."""
    shrink: FloatArray
    """By how much what lies along them is changed, shape (n, n)."""
    log_determinant: float
    """Logarithm of the determinant of the covariance, in units of the variance of a dwell."""

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Transform columns, shape (rows, n) or (rows,)."""
        return np.asarray(columns - self.directions @ (self.shrink @ (self.directions.T @ columns)))


@dataclass(frozen=True, kw_only=True)
class Memory:
    """Everything in a table along which noise can remember."""

    modes: FloatArray
    """A constant and cosines over the run, weighted, shape (rows, 1 + modes); no columns where there is no time."""
    levels: Mapping[str, FloatArray] = field(default_factory=dict)
    """Columns of each effect that draws levels, weighted and scaled to a mean square of one row, by name."""

    @cached_property
    def _whitenings(self) -> dict[NoiseModel, Whitening]:
        return {}

    @cached_property
    def _factors(self) -> dict[tuple[str, ...], tuple[FloatArray, FloatArray]]:
        return {}

    def rows(self, kept: NDArray[np.bool_]) -> "Memory":
        """The same for some of the rows."""
        return Memory(modes=self.modes[kept], levels={name: level[kept] for name, level in self.levels.items()})

    def whitening(self, noise: NoiseModel) -> Whitening:
        """The transformation for a noise model; the identity for white noise."""
        if noise not in self._whitenings:
            self._whitenings[noise] = self._whitening(noise)
        return self._whitenings[noise]

    def _whitening(self, noise: NoiseModel) -> Whitening:
        rows = len(self.modes)
        if noise.white:
            return Whitening(directions=np.empty((rows, 0)), shrink=np.empty((0, 0)), log_determinant=0.0)
        slow = bool(noise.flicker or noise.walk)
        names = tuple(name for name, _ in noise.levels)
        orthonormal, triangular = self._factor(slow, names)
        order = np.arange(1, self.modes.shape[1] * slow)
        waves = noise.flicker / order + noise.walk / (order**2 + noise.corner**2)
        variances = [np.concatenate([[noise.flicker * np.log(2.0)] * slow, waves])]
        variances += [np.full(self.levels[name].shape[1], variance) for name, variance in noise.levels]
        inner = (triangular * np.concatenate(variances)) @ triangular.T
        values, vectors = np.linalg.eigh(inner)
        values = np.clip(values, 0.0, None)
        return Whitening(
            directions=orthonormal,
            shrink=(vectors * (1.0 - 1.0 / np.sqrt(1.0 + values))) @ vectors.T,
            log_determinant=float(np.sum(np.log1p(values))),
        )

    def _factor(self, slow: bool, names: tuple[str, ...]) -> tuple[FloatArray, FloatArray]:
        key = ("*" if slow else "", *names)
        if key not in self._factors:
            parts = [self.modes] if slow else []
            factored = np.linalg.qr(np.column_stack([*parts, *(self.levels[name] for name in names)]))
            self._factors[key] = (factored.Q, factored.R)
        return self._factors[key]


def slow_modes(hours: FloatArray | None, weights: FloatArray) -> FloatArray:
    """A constant and cosines over the run, weighted, shape (rows, 1 + modes); none without time or with few rows.

    The constant is what flicker slower than the run leaves: of the octave below, the power is h ln 2.
    """
    rows = len(weights)
    count = min(MODES, rows // 4)
    if hours is None or count < 4 or np.ptp(hours) <= 0:
        return np.empty((rows, 0))
    phase = np.pi * (hours - hours.min()) / np.ptp(hours)
    cosines = np.sqrt(2.0) * np.cos(np.outer(phase, np.arange(1, count + 1)))
    return np.column_stack([np.ones(rows), cosines]) * np.sqrt(weights)[:, None]


def scaled_levels(columns: FloatArray, weights: FloatArray) -> FloatArray:
    """Weighted level columns, scaled to a mean square of one row."""
    weighted = columns * np.sqrt(weights)[:, None]
    return np.asarray(weighted / np.sqrt(np.mean(np.sum(weighted**2, axis=1))))
