"""Does the model agree with the data: lack of fit and held-out error."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibrations.compression import compress
from calibrations.fit import fit_given_alpha0, joint_fit
from calibrations.geometry import FloatArray
from calibrations.model import coefficients
from calibrations.observations import Observations
from calibrations.repeats import PureError, labels

FOLDS = 3


@dataclass(frozen=True, kw_only=True)
class LackOfFit:
    """Scatter of the pose means about the model against the scatter of repeats (Draper and Smith, 2.1)."""

    variance_v2: float
    """Mean square of the lack of fit, in square volts; NaN without spare poses."""
    degrees_of_freedom: int
    p_value: float | None
    """Chance of so large a ratio if the model were complete; None where there are no repeats or no spare poses."""


def lack_of_fit(squares_v2: float, rows: int, fitted: int, error: PureError) -> LackOfFit:
    """F test of the joint fit; `squares_v2` is its weighted sum of squares, `fitted` its number of parameters."""
    from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

    freedom = rows - fitted - error.degrees_of_freedom
    if freedom < 1:
        return LackOfFit(variance_v2=float("nan"), degrees_of_freedom=0, p_value=None)
    pure = error.variance_v2 * error.degrees_of_freedom if error.degrees_of_freedom else 0.0
    variance = max(squares_v2 - pure, 0.0) / freedom
    if not error.degrees_of_freedom or error.variance_v2 <= 0:
        return LackOfFit(variance_v2=variance, degrees_of_freedom=freedom, p_value=None)
    p_value = float(fdtrc(freedom, error.degrees_of_freedom, variance / error.variance_v2))
    return LackOfFit(variance_v2=variance, degrees_of_freedom=freedom, p_value=p_value)


def held_out_parts(observations: Observations) -> list[NDArray[np.bool_]]:
    """Which rows are held out together: whole realisations in up to three groups; a single one is interleaved."""
    part = labels(observations.realisations) % FOLDS
    if part.max(initial=0) == 0:
        part = np.arange(len(observations)) % FOLDS
    return [part == number for number in range(int(part.max(initial=0)) + 1)]


def held_out_rms(
    observations: Observations, basis: FloatArray, weights: FloatArray, alpha0_fitted: bool
) -> float | None:
    """Root mean square error, in volts, of predicting rows of `held_out_parts` from the others.

    None where too few rows remain to fit.
    """
    error = np.empty(len(observations))
    for out in held_out_parts(observations):
        if np.count_nonzero(~out) < basis.shape[1]:
            return None
        kept = compress(basis[~out], observations.output_v[~out], weights[~out])
        fit = joint_fit(kept) if alpha0_fitted else fit_given_alpha0(kept, 0.0)
        error[out] = observations.output_v[out] - basis[out] @ coefficients(fit.theta)
    return float(np.sqrt(np.mean(error**2)))
