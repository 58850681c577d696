"""Reduces any number of rows to the few numbers that a model can see.

A declared model is a combination of some functions of the settings, an augmented one of a few more. An orthogonal
transformation separates what those can follow from the rest, whose sum of squares no parameter changes: so a fit, a
profile or a Monte Carlo trial works on some ten numbers instead of thousands of rows, with the same result to rounding.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray

_BLOCK = 32
"""Columns that LAPACK takes at a time."""


@dataclass(frozen=True, kw_only=True)
class Compressed:
    """Weighted rows seen through the basis: `z = r @ coefficients + noise`, noise of equal variance."""

    r: FloatArray
    """Triangular factor, shape (columns, columns)."""
    z: FloatArray
    """Rotated voltages, shape (columns,), in volts."""
    rotation: FloatArray
    """Weighted orthonormal columns, shape (rows, columns): `rotation.T @ error_v` is what row errors do to z."""
    rest_v2: float
    """Weighted sum of squares that no choice of coefficients can reach, in square volts."""

    def knowing(self, place: int, value: float, weight_v: float) -> "Compressed":
        """The same with one row more, that no dwell gave: of a coefficient it is known that it is near a value.

        `weight_v` is the standard deviation of a row of weight 1 over that of the coefficient about the value.
        """
        row = np.zeros(self.r.shape[1])
        row[place] = weight_v
        q, r = np.linalg.qr(np.vstack([self.r, row]))
        seen = np.append(self.z, weight_v * value)
        z = q.T @ seen
        rest = seen - q @ z
        return Compressed(r=r, z=z, rotation=self.rotation @ q[:-1], rest_v2=self.rest_v2 + float(rest @ rest))


Whiten: TypeAlias = Callable[[FloatArray], FloatArray]
"""A symmetric linear transformation of columns, shape (rows, n) or (rows,), after which noise is white."""


def unchanged(columns: FloatArray) -> FloatArray:
    """For noise that is white already."""
    return columns


def compress(basis: FloatArray, voltage_v: FloatArray, weights: FloatArray, whiten: Whiten = unchanged) -> Compressed:
    """Compress rows.

    `basis` holds the functions of the declared model and any further columns, shape (rows, columns).
    """
    root = np.sqrt(weights)
    padding = max(0, basis.shape[1] - basis.shape[0])
    q, r = np.linalg.qr(np.pad(whiten(basis * root[:, None]), ((0, padding), (0, 0))))
    q = q[: basis.shape[0]]
    weighted_v = whiten(voltage_v * root)
    z = q.T @ weighted_v
    rest = weighted_v - q @ z
    return Compressed(r=r, z=z, rotation=whiten(q) * root[:, None], rest_v2=float(rest @ rest))


def triangular_factor(columns: FloatArray) -> FloatArray:
    """R of columns = Q R, shape (min(rows, n), n): all that a fit needs where the rows themselves are not asked for."""
    from scipy.linalg.lapack import dgeqrf

    rows, size = columns.shape
    factored = dgeqrf(columns, lwork=_BLOCK * max(size, 1))[0][: min(rows, size)]
    return np.where(_upper(*factored.shape), factored, 0.0)


@cache
def _upper(rows: int, columns: int) -> NDArray[np.bool_]:
    """Where an upper triangle is."""
    return np.triu(np.ones((rows, columns), dtype=bool))
