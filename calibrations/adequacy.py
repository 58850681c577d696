"""Does the model agree with the data: lack of fit and held-out error."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.compression import compress
from tumble.calibrations.fit import fit_given_alpha0, joint_fit
from tumble.calibrations.geometry import FloatArray
from tumble.calibrations.model import coefficients, coefficients_jacobian
from tumble.calibrations.observations import Observations
from tumble.calibrations.repeats import PureError, distinct_settings

FOLDS = 3
FEW_SETTINGS = 12
"""So few are held out one by one."""


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


def held_out_parts(observations: Observations) -> list[NDArray[np.bool_]]:
    """Which rows are held out together: whole settings, so that no repeat of a row that is held out stays in.

    One setting after the other where there are few, else every third one together.
    """
    setting = distinct_settings(observations)
    count = int(setting.max(initial=-1)) + 1
    part = setting if count <= FEW_SETTINGS else setting % FOLDS
    return [part == number for number in range(int(part.max(initial=-1)) + 1)]


def told_without(columns: FloatArray, out: NDArray[np.bool_]) -> bool:
    """Whether the other rows tell everything that all rows tell, and there are more of them than that takes.

    `columns` are what the model can follow, shape (rows, n).
    """
    rank, left = int(np.linalg.matrix_rank(columns)), columns[~out]
    return len(left) > rank and int(np.linalg.matrix_rank(left)) == rank


def held_out_rms(
    observations: Observations, basis: FloatArray, weights: FloatArray, alpha0_fitted: bool
) -> float | None:
    """Root mean square error, in volts, of predicting rows of `held_out_parts` from the others.

    Settings without which the others do not tell the model cannot be predicted; None where none can.
    """
    everything = joint_fit(compress(basis, observations.output_v, weights)).theta
    columns = basis @ coefficients_jacobian(everything)
    errors = [np.empty(0)]
    for out in held_out_parts(observations):
        if not told_without(columns, out):
            continue
        kept = compress(basis[~out], observations.output_v[~out], weights[~out])
        fit = joint_fit(kept) if alpha0_fitted else fit_given_alpha0(kept, 0.0)
        errors.append(observations.output_v[out] - basis[out] @ coefficients(fit.theta))
    error = np.concatenate(errors)
    return float(np.sqrt(np.mean(error**2))) if len(error) else None
