"""The published formula for three positions, mended: heading and drift by Cramer's rule.

Meleshko, Kornejchuk, Skudneva 2008, equations 12 to 19. Printed were c1 with the wrong sign in (18) and a wrong
numerator in (19), an arctangent that loses the quadrant, and S1 + S3 for the drift, which is half of it. With the turn
δ_i from the first position, the tilts γ_i and β_i, and ωη = U cos φ,

    S_i = a_i sin α0 + b_i cos α0 + ω,
    a = ωη (cos δ cos γ - sin δ sin γ sin β),   b = ωη (sin δ cos γ + cos δ sin γ sin β).

It takes no account of the noise, of the closure sin² + cos² = 1, or of the axis about which δ is read: a baseline.
"""

from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class ThreePositions:
    """Heading and drift of one run, or of many: arrays of shape (runs,)."""

    alpha0_deg: FloatArray
    """Above -180 up to 180."""
    drift_deg_h: FloatArray
    closure: FloatArray
    """sin² + cos² as they come out; 1 where nothing errs."""


def three_positions(
    rate_deg_h: FloatArray,
    delta_deg: FloatArray,
    north_deg_h: FloatArray | float,
    gamma_deg: FloatArray | float = 0.0,
    beta_deg: FloatArray | float = 0.0,
) -> ThreePositions:
    """Heading and drift from the rates at three positions, shape (..., 3), with the tilts as measured.

    Raises
    ------
    ValueError
        Positions that coincide, of which no heading follows.
    """
    a, b = coefficients(delta_deg, north_deg_h, gamma_deg, beta_deg)
    f1, f2 = (rate_deg_h[..., i] - rate_deg_h[..., i + 1] for i in (0, 1))
    c1, c2 = (a[..., i] - a[..., i + 1] for i in (0, 1))
    d1, d2 = (b[..., i] - b[..., i + 1] for i in (0, 1))
    determinant = c1 * d2 - c2 * d1
    if np.any(determinant == 0.0):
        raise ValueError(Message("three positions that differ are needed"))
    sine, cosine = (f1 * d2 - f2 * d1) / determinant, (c1 * f2 - c2 * f1) / determinant
    drift = np.mean(rate_deg_h - a * sine[..., None] - b * cosine[..., None], axis=-1)
    return ThreePositions(
        alpha0_deg=np.rad2deg(np.arctan2(sine, cosine)), drift_deg_h=np.asarray(drift), closure=sine**2 + cosine**2
    )


def coefficients(
    delta_deg: FloatArray, north_deg_h: FloatArray | float, gamma_deg: FloatArray | float, beta_deg: FloatArray | float
) -> tuple[FloatArray, FloatArray]:
    """A and b of each position, in degrees per hour."""
    delta, gamma, beta = (np.deg2rad(each) for each in (delta_deg, gamma_deg, beta_deg))
    across = np.sin(gamma) * np.sin(beta)
    return (
        np.asarray(north_deg_h * (np.cos(delta) * np.cos(gamma) - np.sin(delta) * across)),
        np.asarray(north_deg_h * (np.sin(delta) * np.cos(gamma) + np.cos(delta) * across)),
    )
