"""Noise that remembers: flicker and random walk beside white noise, as slow modes of the time of the run.

A mean-free random walk is a sum of cosines with variances falling as 1/k² (Karhunen-Loève expansion of the centred
Wiener process), flicker one with variances falling as 1/k (power spectral density h/f). What the modes do not reach is
white to the eye of a dwell.
"""

from dataclasses import dataclass

import numpy as np

from calibrations.geometry import FloatArray

MODES = 100


@dataclass(frozen=True, kw_only=True)
class NoiseModel:
    """Variances of the first mode relative to the variance of a dwell."""

    flicker: float = 0.0
    walk: float = 0.0

    @property
    def white(self) -> bool:
        """Whether there is nothing but white noise."""
        return self.flicker == 0.0 and self.walk == 0.0


@dataclass(frozen=True, kw_only=True)
class Modes:
    """Slow modes at the times of the rows."""

    orthonormal: FloatArray
    """Shape (rows, modes)."""
    triangular: FloatArray
    """Shape (modes, modes): cosines = orthonormal @ triangular."""


@dataclass(frozen=True, kw_only=True)
class Whitening:
    """A linear transformation after which the noise is white."""

    directions: FloatArray
    """Orthonormal, shape (rows, modes)."""
    shrink: FloatArray
    """By how much each direction is shortened, from 0 to 1."""
    log_determinant: float
    """Logarithm of the determinant of the covariance, in units of the variance of a dwell."""

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Transform columns, shape (rows, n) or (rows,)."""
        along = self.directions.T @ columns
        scaled = along * self.shrink if along.ndim == 1 else along * self.shrink[:, None]
        return np.asarray(columns - self.directions @ scaled)


def slow_modes(hours: FloatArray | None, weights: FloatArray) -> Modes | None:
    """Cosines over the run; None where the table has no time or too few rows."""
    rows = len(weights)
    count = min(MODES, rows // 4)
    if hours is None or count < 4 or np.ptp(hours) <= 0:
        return None
    phase = np.pi * (hours - hours.min()) / np.ptp(hours)
    cosines = np.sqrt(2.0) * np.cos(np.outer(phase, np.arange(1, count + 1)))
    orthonormal, triangular = np.linalg.qr(cosines * np.sqrt(weights)[:, None])
    return Modes(orthonormal=orthonormal, triangular=triangular)


def whitening(modes: Modes | None, noise: NoiseModel, rows: int) -> Whitening:
    """The transformation for a noise model; the identity for white noise."""
    if modes is None or noise.white:
        return Whitening(directions=np.empty((rows, 0)), shrink=np.empty(0), log_determinant=0.0)
    order = np.arange(1, modes.triangular.shape[1] + 1)
    variance = noise.flicker / order + noise.walk / order**2
    inner = (modes.triangular * variance) @ modes.triangular.T
    values, vectors = np.linalg.eigh(inner)
    values = np.clip(values, 0.0, None)
    return Whitening(
        directions=modes.orthonormal @ vectors,
        shrink=1.0 - 1.0 / np.sqrt(1.0 + values),
        log_determinant=float(np.sum(np.log1p(values))),
    )
