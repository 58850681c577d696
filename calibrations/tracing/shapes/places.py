"""What shapes that are fixed by places of a variable have in common."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.coordinate import IntArray

FEWEST_PLACES: Final = 10
"""With fewer values, a step between them is any difference between them."""


def squares_between(gram: FloatArray, first: IntArray, last: IntArray) -> FloatArray:
    """Squares of the differences of columns, from their products."""
    length = np.diag(gram)
    return np.asarray(length[first] + length[last] - 2.0 * gram[first, last])


def levels(part: FloatArray, places: FloatArray) -> FloatArray:
    """A step at each of the places, where rows are at a part of a range: shape (rows, places)."""
    return (part[:, None] > places).astype(float)
