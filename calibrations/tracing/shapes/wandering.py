"""A course that wanders and is pulled back to its mean (Ornstein and Uhlenbeck), as cosines over a range."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.noise import MODES

PULLED_BACK: Final = (0.027, 0.08)
"""Lengths over which it is, in ranges of the variable; one that is longer is a random walk to a run."""


def wandering(part: FloatArray, length: float) -> FloatArray:
    """Columns with independent coefficients of one variance, shape (rows, modes), each row at its part of the range.

    The power spectral density falls as 1/f² from the mode of half a turn on in which π modes are a length.
    """
    count = min(MODES, len(part) // 4)
    order = np.arange(1, count + 1)
    cosines = np.sqrt(2.0) * np.cos(np.pi * np.outer(part, order))
    return np.asarray(cosines / np.sqrt(order**2 + (np.pi * length) ** -2.0))
