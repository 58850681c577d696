"""What of many points a reader can see: those that would cover one another are drawn once."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray

MOST: Final = 4000
"""So many points of a layer are drawn at most; a page of figures with that many weighs less than a megabyte."""
_STEPS: Final = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0)
"""Sizes of the cells of which one point each is drawn, in units of which a page is 720 wide."""


def seen_marks(across: FloatArray, up: FloatArray) -> NDArray[np.intp]:
    """Places in the arrays of the marks to draw: the first one of each cell, in cells as small as `MOST` allows."""
    seen = np.flatnonzero(np.isfinite(across) & np.isfinite(up))
    for step in _STEPS:
        if len(seen) <= MOST:
            break
        cells = np.round(across[seen] / step) * 1e6 + np.round(up[seen] / step)
        seen = seen[np.sort(np.unique(cells, return_index=True)[1])]
    return seen


def seen_line(across: FloatArray, up: FloatArray) -> NDArray[np.intp]:
    """Places in the arrays of the points to join: of many, the lowest and highest of each column as wide as a pen.

    A line that doubles back, or that breaks, is drawn whole.
    """
    every = np.arange(len(across), dtype=np.intp)
    if len(across) <= MOST or not np.isfinite(across + up).all() or (np.diff(across) < 0).any():
        return every
    columns = np.round(across / _STEPS[0])
    begins = np.flatnonzero(np.r_[True, np.diff(columns) > 0])
    groups = np.split(up, begins[1:])
    lowest = begins + [int(np.argmin(group)) for group in groups]
    highest = begins + [int(np.argmax(group)) for group in groups]
    return np.unique(np.concatenate([begins, lowest, highest, [len(across) - 1]]))
