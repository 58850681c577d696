"""To how many digits outputs are written, and whether a model says more of them than that."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

_EPSILON: Final = float(np.finfo(np.float64).eps)
_DECADES: Final = range(-15, 19)
_SLACK: Final = 1e-6
"""Of a digit: what sums of binary fractions lose of it."""


def last_digit(values: FloatArray) -> float:
    """The decimal step in which values are written, in their unit, or what a double can tell apart if that is more.

    Shape (n,); with no value but 0, the smallest step there is.
    """
    largest = float(np.abs(values).max(initial=0.0))
    if largest == 0.0:
        return 10.0 ** -_DECADES[-1]
    least = 16 * _EPSILON * largest
    for decade in _DECADES:
        scaled = values * 10.0**decade
        if np.all(np.abs(scaled - np.round(scaled)) <= 4 * _EPSILON * np.abs(scaled)):
            return max(10.0**-decade, least)
    return max(10.0 ** -_DECADES[-1], least)


def as_written(functions: FloatArray, output: FloatArray) -> bool:
    """Whether some coefficients of the functions give every output to within half its last digit.

    `functions` has shape (rows, n), `output` (rows,), as it was written.
    """
    digit = last_digit(output)
    columns = functions / np.maximum(np.linalg.norm(functions, axis=0), _EPSILON)
    residual = output - columns @ np.linalg.lstsq(columns, output, rcond=None)[0]
    if np.abs(residual).max(initial=0.0) > digit:
        return False
    from scipy.optimize import linprog  # asked by few tables

    away = np.ones((len(output), 1))
    nearest = linprog(
        np.r_[np.zeros(columns.shape[1]), 1.0],
        A_ub=np.vstack([np.hstack([columns, -away]), np.hstack([-columns, -away])]),
        b_ub=np.r_[residual, -residual] / digit,
        bounds=[(None, None)] * columns.shape[1] + [(0, None)],
    )  # the fit whose largest residual is least (Chebyshev)
    return nearest.x is not None and bool(nearest.x[-1] <= 0.5 + _SLACK)
