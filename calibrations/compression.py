"""Reduces any number of rows to the ten numbers that the declared model can see.

The model is a combination of ten functions of the pose. An orthogonal transformation separates what those can follow
from the rest, whose sum of squares no parameter changes: so a fit, a profile or a Monte Carlo trial works on ten
numbers instead of thousands of rows, with the same result to rounding.
"""

from dataclasses import dataclass

import numpy as np

from calibrations.geometry import FloatArray


@dataclass(frozen=True, kw_only=True)
class Compressed:
    """Weighted rows seen through the basis: `z = r @ coefficients + noise`, noise of equal variance."""

    r: FloatArray
    """Triangular factor, shape (10, 10)."""
    z: FloatArray
    """Rotated voltages, shape (10,), in volts."""
    rotation: FloatArray
    """Weighted orthonormal columns, shape (rows, 10): `rotation.T @ error_v` is what an error in the rows does to z."""
    rest_v2: float
    """Weighted sum of squares that no choice of coefficients can reach, in square volts."""


def compress(basis: FloatArray, voltage_v: FloatArray, weights: FloatArray) -> Compressed:
    """Compress rows; `basis` has shape (rows, 10), the others (rows,)."""
    root = np.sqrt(weights)
    padding = max(0, basis.shape[1] - basis.shape[0])
    padded = np.pad(basis * root[:, None], ((0, padding), (0, 0)))
    q, r = np.linalg.qr(padded)
    q = q[: basis.shape[0]]
    weighted_v = voltage_v * root
    z = q.T @ weighted_v
    rest = weighted_v - q @ z
    return Compressed(r=r, z=z, rotation=q * root[:, None], rest_v2=float(rest @ rest))
