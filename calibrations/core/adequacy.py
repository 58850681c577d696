"""Does the model agree with the data: lack of fit and held-out error."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import PureError


@dataclass(frozen=True, kw_only=True)
class LackOfFit:
    """Scatter of the pose means about the model against the scatter of repeats (Draper and Smith, 2.1)."""

    variance: float
    """Mean square of the lack of fit, in the square of the unit of the output; NaN without spare poses."""
    degrees_of_freedom: int
    p_value: float | None
    """Chance of so large a ratio if the model were complete; None where there are no repeats or no spare poses."""


def lack_of_fit(squares_v2: float, rows: int, fitted: int, error: PureError) -> LackOfFit:
    """F test of the joint fit; `squares_v2` is its weighted sum of squares, `fitted` its number of parameters."""
    from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

    freedom = rows - fitted - error.degrees_of_freedom
    if freedom < 1:
        return LackOfFit(variance=float("nan"), degrees_of_freedom=0, p_value=None)
    pure = error.variance * error.degrees_of_freedom if error.degrees_of_freedom else 0.0
    variance = max(squares_v2 - pure, 0.0) / freedom
    if not error.degrees_of_freedom or error.variance <= 0:
        return LackOfFit(variance=variance, degrees_of_freedom=freedom, p_value=None)
    p_value = float(fdtrc(freedom, error.degrees_of_freedom, variance / error.variance))
    return LackOfFit(variance=variance, degrees_of_freedom=freedom, p_value=p_value)


def told_without(columns: FloatArray, out: NDArray[np.bool_]) -> bool:
    """Whether the other rows tell everything that all rows tell, and there are more of them than that takes.

    `columns` are what the model can follow, shape (rows, n).
    """
    rank, left = int(np.linalg.matrix_rank(columns)), columns[~out]
    return len(left) > rank and int(np.linalg.matrix_rank(left)) == rank
