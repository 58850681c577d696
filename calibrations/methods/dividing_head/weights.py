"""Weights of dwells: by their kind, where repeats say that kinds scatter differently."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import PureError, labels, pure_error
from tumble.calibrations.methods.dividing_head.observations import Observations

UNEQUAL_P = 1e-3
"""Kinds of dwell are weighted differently only where their repeats differ beyond this chance."""


def dwell_weights(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """Weight of every row, mean 1, from the repeats of its kind of dwell.

    A kind is a procedure with a number of samples. All rows weigh the same unless Bartlett's test (Snedecor and
    Cochran, Statistical Methods, 10.21) says that the kinds scatter differently.
    """
    kinds = _kinds(observations)
    ones = np.ones(len(residual_v))
    errors = [pure_error(residual_v[kinds == kind], groups[kinds == kind], ones[kinds == kind])
              for kind in range(kinds.max(initial=0) + 1)]  # fmt: skip
    if len(errors) < 2 or not _scatter_differs(errors):
        return ones
    pooled = pure_error(residual_v, groups, ones).variance
    variances = np.array([e.variance if e.degrees_of_freedom > 1 else pooled for e in errors])
    weights: FloatArray = 1.0 / variances[kinds]
    return np.asarray(weights / weights.mean())


def robust_weights(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """The same while gross errors are still among the rows: of each kind they count as three robust deviations."""
    kinds = _kinds(observations)
    middle_v = np.array([np.median(np.abs(residual_v[kinds == kind])) for kind in range(kinds.max(initial=0) + 1)])
    limit_v = _ROBUST * middle_v[kinds]
    return dwell_weights(observations, np.clip(residual_v, -limit_v, limit_v), groups)


_ROBUST = 3.0 * 1.4826
"""Three standard deviations, in median absolute deviations of normal noise."""


def weights_of_all(observations: Observations, used: Observations, weights: FloatArray) -> FloatArray:
    """Weights of all rows of a table by those of the rows in use, each as its kind; of another kind, 1."""
    kinds, known = _kinds(observations), np.isin(observations.row, used.row)
    of_kind = np.ones(int(kinds.max(initial=0)) + 1)
    of_kind[kinds[known]] = weights
    return np.asarray(of_kind[kinds])


def _kinds(observations: Observations) -> NDArray[np.int64]:
    columns: list[NDArray[np.generic]] = [np.zeros(len(observations), dtype=np.int64)]
    if observations.procedure is not None:
        columns.append(observations.procedure)
    if observations.samples is not None:
        columns.append(observations.samples)
    return labels(*columns)


def _scatter_differs(errors: list[PureError]) -> bool:
    from scipy.special import chdtrc  # takes a tenth of a second, in which a window is half up

    known = [e for e in errors if e.degrees_of_freedom > 1 and e.variance > 0]
    if len(known) < 2:
        return False
    freedom = np.array([e.degrees_of_freedom for e in known], dtype=float)
    variance = np.array([e.variance for e in known])
    total = freedom.sum()
    pooled = float(np.sum(freedom * variance) / total)
    correction = 1 + (np.sum(1 / freedom) - 1 / total) / (3 * (len(known) - 1))
    statistic = (total * np.log(pooled) - np.sum(freedom * np.log(variance))) / correction
    return bool(chdtrc(len(known) - 1, statistic) < UNEQUAL_P)
