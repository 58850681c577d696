"""Values that are set again and again, only nearly the same: which of them are one setting."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import settings

_APART = 10.0
"""Settings lie so many times as far apart as one of them scatters."""
_COME_BACK = 1.5
"""So often must settings come back on average, if they are to be taken for settings at all."""


def clusters(values: FloatArray, roundings: Sequence[float]) -> NDArray[np.int64]:
    """Number of the setting of each value, from 0 in ascending order.

    `roundings` are how closely a value may be set again, ascending. The closest is taken at which settings come back
    and lie far apart beside it; the first of them where that is so at none.
    """
    for rounding in roundings:
        number = settings(values, rounding)
        often = len(values) >= _COME_BACK * (number.max(initial=0) + 1)
        if often and _clear(values, number, rounding):
            return number
    return settings(values, roundings[0])


def _clear(values: FloatArray, number: NDArray[np.int64], rounding: float) -> bool:
    """Whether settings lie far apart beside what one of them may scatter by."""
    spacing = np.diff(np.bincount(number, weights=values) / np.bincount(number))
    return bool(len(spacing) and spacing.min() > _APART * rounding)


def as_they_come(number: NDArray[np.int64]) -> NDArray[np.int64]:
    """The same groups, numbered as they first come."""
    _, first, inverse = np.unique(number, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[inverse])
