"""Earth rate in the levelling channel of a levelled platform, in pickoff angles of a turntable that leans.

East, north, up; α is the angle of the platform's axis from north, counterclockwise seen from above, α0 at pickoff angle
0; ωη = U cos φ and ωζ = U sin φ are the north and the upward part of the earth rate U. With the lean of `lean`,

    S = ωη (P cos δ + Q sin δ) + drift,
    P = sin α0 cos γ0,   Q = cos α0 cos κ + sin α0 sin γ0 sin κ,   sin γ0 = A,   sin κ = -B / cos γ0.

Source: Meleshko, Kornejchuk, Skudneva 2008, equations 5, 9, 12 and 13, here for an angle that is read about the leaning
axis. For each base S is an exact combination of two functions of δ with the coefficients sin α0 and cos α0.
"""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.lean import Lean

EARTH_RATE_DEG_H: Final = 15.041068
"""U: one turn in a sidereal day."""


def north_rate(latitude_deg: FloatArray) -> FloatArray:
    """ωη = U cos φ, in degrees per hour."""
    return np.asarray(EARTH_RATE_DEG_H * np.cos(np.deg2rad(latitude_deg)))


def up_rate(latitude_deg: FloatArray) -> FloatArray:
    """ωζ = U sin φ, in degrees per hour."""
    return np.asarray(EARTH_RATE_DEG_H * np.sin(np.deg2rad(latitude_deg)))


def heading_functions(delta_rad: FloatArray, latitude_deg: FloatArray, lean: Lean) -> FloatArray:
    """What sin α0 and cos α0 are multiplied by in S, shape (rows, 2), in degrees per hour."""
    return _functions(np.cos(delta_rad), np.sin(delta_rad), latitude_deg, lean)


def heading_slopes(delta_rad: FloatArray, latitude_deg: FloatArray, lean: Lean) -> FloatArray:
    """Their derivatives with respect to δ, shape (rows, 2), in degrees per hour per radian."""
    return _functions(-np.sin(delta_rad), np.cos(delta_rad), latitude_deg, lean)


def _functions(cosine: FloatArray, sine: FloatArray, latitude_deg: FloatArray, lean: Lean) -> FloatArray:
    cos_tilt = np.sqrt(1.0 - lean.cosine**2)
    sin_kappa = -lean.sine / cos_tilt
    cos_kappa = np.sqrt(np.clip(1.0 - sin_kappa**2, 0.0, 1.0))
    of_sine = cos_tilt * cosine + lean.cosine * sin_kappa * sine
    return north_rate(latitude_deg)[:, None] * np.column_stack([of_sine, cos_kappa * sine])


def wrapped_deg(angle_deg: float) -> float:
    """An angle in (-180°, 180°]."""
    return -((-angle_deg + 180.0) % 360.0 - 180.0)


def platform_azimuth_rad(alpha0_rad: float, delta_rad: FloatArray, lean: Lean) -> FloatArray:
    """α of the platform's axis at pickoff angles on a base that leans, in radians, shape (rows,).

    Where the base leans it is not α0 + δ: up to 26′ off at leans of 5° about both axes.
    """
    cos_tilt = np.sqrt(1.0 - lean.cosine**2)
    sin_kappa = -lean.sine / cos_tilt
    cos_kappa = np.sqrt(np.clip(1.0 - sin_kappa**2, 0.0, 1.0))
    along = cos_tilt * np.cos(delta_rad) + lean.cosine * sin_kappa * np.sin(delta_rad)
    return np.asarray(alpha0_rad + np.arctan2(cos_kappa * np.sin(delta_rad), along))
