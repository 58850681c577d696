"""The least that may come of something of which the size is known only so well."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

_HALVINGS: Final = 60


def nearest_to_nothing(products: FloatArray, radius: float) -> float:
    """Least of |l + Ld|² for |d| up to a radius, from the products of l and the columns of L, shape (1 + n, 1 + n).

    As in Levenberg's method: d = -(L'L + m)⁻¹ L'l, with the least m ≥ 0 that keeps d within the radius.
    """
    values, turned = np.linalg.eigh(products[1:, 1:])
    values, along = np.clip(values, 0.0, None), turned.T @ products[0, 1:]

    def step(damping: float) -> FloatArray:
        return np.asarray(-along / (values + damping))

    length = float(products[0, 0])
    low = 1e-12 * float(values.sum())
    if low <= 0.0 or length <= 0.0:
        return max(length, 0.0)
    high = max(float(np.linalg.norm(along)) / radius, low)
    if np.linalg.norm(step(low)) > radius:
        for _ in range(_HALVINGS):
            middle = np.sqrt(low * high)
            low, high = (middle, high) if np.linalg.norm(step(middle)) > radius else (low, middle)
    else:
        high = low
    moved = step(high)
    return max(float(length + 2.0 * along @ moved + values @ moved**2), 0.0)
