"""Whole-period mean products of the accelerations of each dwell: what second-order coefficients multiply."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.observations import VibrationObservations

PAIRS: Final = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2))
"""Axes of the products, in the order of the coefficients: ii, oo, pp, io, ip."""
_FIELDS: Final = ("mii_g2", "moo_g2", "mpp_g2", "mio_g2", "mip_g2")
_EQUAL: Final = 1e-6
"""Relative difference below which two frequencies are one."""
_QUADRATURE: Final = 2e-4
"""Cosine of 90° as far as phases are stated, to a hundredth of a degree: what rounding leaves of it is no product."""


def mean_products(rows: VibrationObservations) -> FloatArray:
    """Whole-period means of Ax Ay without their static part, in g², shape (rows, 5), as in `PAIRS`.

    Of sines ½ ax ay cos(φx - φy) where the frequencies are equal, else 0 (Chen and Dong); as they are stated of rows
    that state them.
    """
    stated = np.column_stack([rows.filled(name) for name in _FIELDS])
    return np.where(rows.stated[:, None], stated, _of_sines(rows))


def static_products(rows: VibrationObservations) -> FloatArray:
    """The same of gravity alone, shape (rows, 5); within a mounting that stands still a constant."""
    return products_of(rows.along("g", "_g"))


def products_of(vectors: FloatArray) -> FloatArray:
    """Products of the components of vectors, shape (rows, 5)."""
    return np.column_stack([vectors[:, first] * vectors[:, second] for first, second in PAIRS])


def _of_sines(rows: VibrationObservations) -> FloatArray:
    peak_g, frequency_hz = rows.along("a", "_g"), rows.along("f", "_hz")
    phase_rad = np.deg2rad(rows.along("phase_", "_deg"))
    columns = []
    for first, second in PAIRS:
        apart = np.abs(frequency_hz[:, first] - frequency_hz[:, second])
        one = apart <= _EQUAL * np.maximum(frequency_hz[:, first], frequency_hz[:, second])
        cosine = np.cos(phase_rad[:, first] - phase_rad[:, second])
        together = one & (np.abs(cosine) > _QUADRATURE)
        columns.append(np.where(together, 0.5 * peak_g[:, first] * peak_g[:, second] * cosine, 0.0))
    return np.column_stack(columns)
