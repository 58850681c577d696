"""How uncertain the heading will be, of a plan of dwells and a gyro whose noise is known.

The drift of the levelling gyro wanders. Its means over two dwells are correlated; generalised least squares with the
exact covariance of these means has the least variance that any unbiased estimate of the heading has.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.geometry import north_rate

_HEADINGS: Final = np.deg2rad(np.arange(0.0, 360.0, 5.0))
_HOUR_S: Final = 3600.0


@dataclass(frozen=True, kw_only=True)
class DriftNoise:
    """How a drift wanders: coefficients of an Allan deviation (IEEE 952-1997, annex C), and a Gauss-Markov process."""

    angle_random_walk_deg_sqrt_h: float = 0.0
    """N."""
    bias_instability_deg_h: float = 0.0
    """B; the floor of the Allan deviation is 0.664 B."""
    rate_random_walk_deg_h_sqrt_h: float = 0.0
    """K."""
    gauss_markov_deg_h: float = 0.0
    """Standard deviation."""
    correlation_s: float = 1000.0

    def covariance(self, starts_s: FloatArray, ends_s: FloatArray) -> FloatArray:
        """Of the means over dwells that do not overlap, shape (dwells, dwells), in (°/h)².

        But for a constant that all have in common, as flicker and random walk have no variance of their own.
        """
        starts, ends = starts_s / _HOUR_S, ends_s / _HOUR_S
        white = np.diag(self.angle_random_walk_deg_sqrt_h**2 / (ends - starts))
        return np.asarray(
            white + self._gauss_markov(starts, ends) + self._random_walk(starts, ends) + self._flicker(starts, ends)
        )

    def _gauss_markov(self, starts: FloatArray, ends: FloatArray) -> FloatArray:
        """σ² exp(-|t|/T), averaged over both dwells."""
        memory, length = self.correlation_s / _HOUR_S, ends - starts
        grown = -np.expm1(-length / memory)
        gap = np.maximum(starts[:, None], starts) - np.minimum(ends[:, None], ends)
        apart = np.exp(-np.maximum(gap, 0.0) / memory) * np.outer(grown, grown) / np.outer(length, length) * memory**2
        own = 2.0 * memory**2 * (length / memory - grown) / length**2
        np.fill_diagonal(apart, own)
        return np.asarray(self.gauss_markov_deg_h**2 * apart)

    def _random_walk(self, starts: FloatArray, ends: FloatArray) -> FloatArray:
        """K² min(s, t), averaged over both dwells."""
        middle = (starts + ends) / 2.0
        both = np.minimum(middle[:, None], middle)
        np.fill_diagonal(both, starts + (ends - starts) / 3.0)
        return np.asarray(self.rate_random_walk_deg_h_sqrt_h**2 * both)

    def _flicker(self, starts: FloatArray, ends: FloatArray) -> FloatArray:
        """-B²/π ln |s - t|, averaged over both dwells: the covariance of a spectral density B²/(2πf), two-sided."""
        total = (
            _twice_integrated(ends - starts[:, None])
            - _twice_integrated(ends - ends[:, None])
            - _twice_integrated(starts - starts[:, None])
            + _twice_integrated(starts - ends[:, None])
        )
        length = ends - starts
        reach = np.log(10.0 * max(float(ends.max() - starts.min()), 1e-9))
        return np.asarray(self.bias_instability_deg_h**2 / np.pi * (reach - total / np.outer(length, length)))


def _twice_integrated(u: FloatArray) -> FloatArray:
    """A function whose second derivative is ln |u|."""
    size = np.abs(u)
    return np.asarray(u**2 / 2.0 * np.log(np.where(size > 0.0, size, 1.0)) - 0.75 * u**2)


@dataclass(frozen=True, kw_only=True)
class ExpectedHeading:
    """Standard uncertainty of the heading, in degrees."""

    rms_deg: float
    """Root mean square over all headings."""
    worst_deg: float
    worst_alpha0_deg: float
    """At which α0 it is greatest."""


def expected_heading(
    azimuths_deg: Sequence[float],
    starts_s: Sequence[float],
    dwell_s: float,
    latitude_deg: float,
    noise: DriftNoise,
    *,
    known_latitude: bool = True,
) -> ExpectedHeading | None:
    """Uncertainty of the heading by generalised least squares with the drift free; None where it is not told.

    Parameters
    ----------
    azimuths_deg, starts_s
        Where each dwell is taken, and when it begins.
    dwell_s
        Averaging time.
    latitude_deg
        Of the stand.
    noise
        Of the levelling gyro.
    known_latitude
        Whether U cos φ is known; else it is fitted, too.
    """
    starts, delta = np.array(starts_s), np.deg2rad(azimuths_deg)
    covariance = noise.covariance(starts, starts + dwell_s)
    whiten = np.linalg.inv(np.linalg.cholesky(covariance))
    north = float(north_rate(np.array([latitude_deg]))[0])
    found = np.array([_variance(whiten, delta + alpha0, north, known_latitude) for alpha0 in _HEADINGS.tolist()])
    if not np.isfinite(found).all():
        return None
    worst = int(np.argmax(found))
    return ExpectedHeading(
        rms_deg=float(np.rad2deg(np.sqrt(found.mean()))),
        worst_deg=float(np.rad2deg(np.sqrt(found[worst]))),
        worst_alpha0_deg=float(np.rad2deg(_HEADINGS[worst])),
    )


def _variance(whiten: FloatArray, alpha: FloatArray, north: float, known_latitude: bool) -> float:
    """Of α0 in rad², infinite where the positions do not tell it."""
    columns = [north * np.cos(alpha), np.ones(len(alpha))]
    if not known_latitude:
        columns.append(np.sin(alpha))
    design = whiten @ np.column_stack(columns)
    information = design.T @ design
    scale = np.sqrt(np.diag(information))
    scaled = information / np.outer(scale, scale)
    if np.linalg.cond(scaled) > 1e10:
        return float("inf")
    return float(np.linalg.inv(scaled)[0, 0] / scale[0] ** 2)
