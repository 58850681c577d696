"""Does the model agree with the data: lack of fit and held-out error."""

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from calibrations.compression import compress
from calibrations.fit import fit_given_alpha0, joint_fit
from calibrations.geometry import FloatArray
from calibrations.model import coefficients
from calibrations.observations import Observations
from calibrations.repeats import PureError, labels

_FOLDS = 5
_MOST_FITS = 10


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
    freedom = rows - fitted - error.degrees_of_freedom
    if freedom < 1:
        return LackOfFit(variance_v2=float("nan"), degrees_of_freedom=0, p_value=None)
    pure = error.variance_v2 * error.degrees_of_freedom if error.degrees_of_freedom else 0.0
    variance = max(squares_v2 - pure, 0.0) / freedom
    if not error.degrees_of_freedom or error.variance_v2 <= 0:
        return LackOfFit(variance_v2=variance, degrees_of_freedom=freedom, p_value=None)
    p_value = float(fdtrc(freedom, error.degrees_of_freedom, variance / error.variance_v2))
    return LackOfFit(variance_v2=variance, degrees_of_freedom=freedom, p_value=p_value)


def held_out_rms(
    observations: Observations, basis: FloatArray, weights: FloatArray, alpha0_fitted: bool
) -> float | None:
    """Root mean square error, in volts, of predicting each realisation from the others.

    More than ten realisations are left out in ten groups; a single one is cut into five interleaved parts. None where
    too few rows remain to fit.
    """
    part = labels(observations.realisations) % _MOST_FITS
    if part.max(initial=0) == 0:
        part = np.arange(len(observations)) % _FOLDS
    error = np.empty(len(observations))
    for number in range(part.max(initial=0) + 1):
        out = part == number
        if np.count_nonzero(~out) < basis.shape[1]:
            return None
        kept = compress(basis[~out], observations.output_v[~out], weights[~out])
        fit = joint_fit(kept) if alpha0_fitted else fit_given_alpha0(kept, 0.0)
        error[out] = observations.output_v[out] - basis[out] @ coefficients(fit.theta)
    return float(np.sqrt(np.mean(error**2)))
