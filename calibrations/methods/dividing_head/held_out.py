"""Error of rows that are held out: predicted from the others."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.adequacy import told_without
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.methods.dividing_head.fit import fit_given_alpha0, joint_fit
from tumble.calibrations.methods.dividing_head.model import coefficients, coefficients_jacobian
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import distinct_settings

FOLDS = 3


FEW_SETTINGS = 12
"""So few are held out one by one."""


def held_out_parts(observations: Observations) -> list[NDArray[np.bool_]]:
    """Which rows are held out together: whole settings, so that no repeat of a row that is held out stays in.

    One setting after the other where there are few, else every third one together.
    """
    setting = distinct_settings(observations)
    count = int(setting.max(initial=-1)) + 1
    part = setting if count <= FEW_SETTINGS else setting % FOLDS
    return [part == number for number in range(int(part.max(initial=-1)) + 1)]


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
