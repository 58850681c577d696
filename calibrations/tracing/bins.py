"""Bins of a variable: cells of places in space, distances between bins, and processes over them."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray

_CELL: Final = 0.15
"""Places closer than this are one."""
_KEPT: Final = 1e-3
"""Directions in which a process varies by less than this part of its largest are left out."""


def cells(places: FloatArray, most: int) -> NDArray[np.int64]:
    """Number of the cell of each place, cells as small as so many of them allow."""
    cell = _CELL
    while True:
        distinct, number = np.unique(np.round(places / cell), axis=0, return_inverse=True)
        if len(distinct) <= max(most, 2 ** places.shape[1]):
            return np.asarray(number, dtype=np.int64).ravel()
        cell *= 1.5


def distances(centres: FloatArray, period: float | None) -> FloatArray:
    """Distances between bins in ranges of the variable; round a circle, half its circumference is the range."""
    apart = centres[:, None, :] - centres[None, :, :]
    if period is not None:
        return np.asarray(np.abs(2.0 * np.sin(np.pi * apart[..., 0] / period)) / 2.0)
    away = np.linalg.norm(apart, axis=-1)
    return np.asarray(away / max(float(away.max()), 1e-300))


def root(kernel: FloatArray) -> FloatArray:
    """Columns whose products with themselves are a kernel, shape (bins, directions)."""
    values, vectors = np.linalg.eigh(kernel)
    kept = values > _KEPT * values[-1]
    return np.asarray(vectors[:, kept] * np.sqrt(values[kept]))
