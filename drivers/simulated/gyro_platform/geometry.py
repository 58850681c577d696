"""East, north and up seen from the platform, by turning vectors through one frame after the other.

The base is turned from east, north and up by Rz(α) Ry(γ) Rx(κ); on it the turntable by Rz(δ), its levelling axis being
x; on that the platform by Rx(b), which the loop holds so that its y axis is level.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray

EARTH_DEG_H: Final = 15.041068
"""Rate of the earth's rotation."""
_PLANES: Final = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


def turned(vectors: FloatArray, axis: str, angles_rad: FloatArray | float) -> FloatArray:
    """Vectors, shape (rows, 3), turned right-handed about an axis of the frame in which they are given."""
    first, second = _PLANES[axis]
    cosine, sine = np.cos(angles_rad), np.sin(angles_rad)
    result = vectors.copy()
    result[:, first] = cosine * vectors[:, first] - sine * vectors[:, second]
    result[:, second] = sine * vectors[:, first] + cosine * vectors[:, second]
    return result


def table_axes(alpha_rad: FloatArray, lean_deg: Sequence[float], delta_rad: FloatArray) -> tuple[FloatArray, ...]:
    """The turntable's x, y and z axes in east, north and up, each of the shape (rows, 3)."""
    gamma_rad, kappa_rad = np.deg2rad(lean_deg)
    axes = []
    for column in np.eye(3):
        vectors = np.tile(column, (len(delta_rad), 1))
        leaning = turned(turned(turned(vectors, "z", delta_rad), "x", kappa_rad), "y", gamma_rad)
        axes.append(turned(leaning, "z", alpha_rad))
    return tuple(axes)


def earth_rate_deg_h(latitude_deg: float) -> FloatArray:
    """The earth's rotation in east, north and up, shape (3,)."""
    latitude_rad = np.deg2rad(latitude_deg)
    return EARTH_DEG_H * np.array([0.0, np.cos(latitude_rad), np.sin(latitude_rad)])
