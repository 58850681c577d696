"""Sums of rows times waves of every number of turns over the range of a variable, by a Fourier transform.

Rows are put on a grid so fine that the phase of the fastest wave is nowhere off by more than π/16: that costs it a
hundredth of its power, and a scan of waves is followed by an exact one about the best of them.
"""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

TURNS_APART: Final = 0.5
"""Waves are tried so many turns over the range apart: half of what parts two of them."""
_CELLS: Final = 16
"""Cells of the grid for each wave."""


def wave_sums(part: FloatArray, waves: int, columns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sums of columns, shape (rows, n), times sines and cosines of so many waves: two of shape (n, waves).

    `part` is where each row is in the range, from 0 to 1; the waves have 1, 2, 3 … times `TURNS_APART` turns.
    """
    from scipy.fft import rfft  # takes a tenth of a second, in which a window is half up

    size = 1 << (_CELLS * waves).bit_length()
    cell = np.round(part * (TURNS_APART * size)).astype(np.int64)
    on_grid = np.zeros((columns.shape[1], size), dtype=np.float32)
    for row, column in zip(on_grid, columns.T, strict=True):
        np.add.at(row, cell, column.astype(np.float32))
    found = rfft(on_grid, axis=1)[:, 1 : waves + 1].astype(np.complex128)
    return np.asarray(-found.imag), np.asarray(found.real)


def wave_squares(part: FloatArray, waves: int, weights: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Weighted sums of the squares of the same sines, of the cosines, and of sine times cosine, each (waves,)."""
    sines, cosines = (each[0, 1::2] for each in wave_sums(part, 2 * waves, weights[:, None]))
    total = float(weights.sum())
    return (total - cosines) / 2.0, (total + cosines) / 2.0, sines / 2.0
