"""Weights of dwells: by their kind where repeats say that kinds scatter differently, by their samples in a burst."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import PureError, labels, pure_error, without_levels
from tumble.calibrations.methods.dividing_head.observations import Observations

UNEQUAL_P = 1e-3
"""Kinds of dwell are weighted differently only where their repeats differ beyond this chance."""
DISTURBED = 3.0
"""A dwell whose samples scatter so many times as much as is usual among its kind was disturbed, whatever its mean."""
_FEWEST = 3
"""Disturbed dwells that tell how much more they scatter."""
_ROBUST = 3.0 * 1.4826
"""Three standard deviations, in median absolute deviations of normal noise."""


def dwell_weights(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """Weight of every row, mean 1, from the repeats of its kind of dwell, and of dwells that were disturbed.

    A kind is a procedure with a number of samples. All rows weigh the same unless Bartlett's test (Snedecor and
    Cochran, Statistical Methods, 10.21) says that the kinds scatter differently.
    """
    by_kind, by_disturbance = (of(observations, residual_v, groups) for of in (_by_kind, _by_disturbance))
    if np.all(by_disturbance == 1.0):
        return by_kind
    weights = by_kind * by_disturbance
    return np.asarray(weights / weights.mean())


def _by_kind(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    kinds = _kinds(observations)
    ones = np.ones(len(residual_v))
    errors = _errors(residual_v, groups, kinds)
    if len(errors) < 2 or not _scatter_differs(errors):
        return ones
    if not _scatter_differs(_errors(_without_shifts(observations, residual_v, groups), groups, kinds)):
        return ones
    pooled = pure_error(residual_v, groups, ones).variance
    variances = np.array([e.variance if e.degrees_of_freedom > 1 else pooled for e in errors])
    weights: FloatArray = 1.0 / variances[kinds]
    return np.asarray(weights / weights.mean())


def _errors(residual_v: FloatArray, groups: NDArray[np.int64], kinds: NDArray[np.int64]) -> list[PureError]:
    """Scatter of the repeats of each kind."""
    ones = np.ones(len(residual_v))
    return [
        pure_error(residual_v[kinds == kind], groups[kinds == kind], ones[kinds == kind])
        for kind in range(kinds.max(initial=0) + 1)
    ]


def _without_shifts(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """The residuals but for what drifted from one realisation to the next: no kind of dwell scatters by that."""
    if observations.realisation is None:
        return residual_v
    return without_levels(residual_v, groups, labels(observations.realisation))


def _by_disturbance(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """1 but for dwells whose samples scatter far more than those of their kind, and which scatter more themselves.

    They are held against the calm visits of their pose. What goes with the power of the scatter is taken off, for that
    is rectified vibration and no noise; where more is left than chance allows (chi-squared at `UNEQUAL_P`), the
    variance of such a dwell goes with that of its samples.
    """
    weights = np.ones(len(residual_v))
    ratio = times_usual(observations)
    disturbed = ratio > DISTURBED
    calm = np.bincount(groups[~disturbed], minlength=int(groups.max(initial=0)) + 1)
    rows = np.flatnonzero(disturbed & (calm[groups] > 0))
    variance = pure_error(residual_v[~disturbed], groups[~disturbed], weights[~disturbed]).variance
    if len(rows) < _FEWEST or not variance > 0:
        return weights
    mean = np.bincount(groups[~disturbed], residual_v[~disturbed], len(calm))[groups[rows]] / calm[groups[rows]]
    away = (residual_v[rows] - mean) / np.sqrt(variance * (1.0 + 1.0 / calm[groups[rows]]))
    power = ratio[rows] ** 2
    away -= power * (away @ power) / (power @ power)
    if not _beyond_chance(away):
        return weights
    grown = float(np.mean(away**2 / power) * len(rows) / (len(rows) - 1))
    weights[disturbed] = 1.0 / np.maximum(1.0, grown * ratio[disturbed] ** 2)
    return weights


def times_usual(observations: Observations) -> FloatArray:
    """Deviation of the samples of each dwell over the median of its kind; 1 where the table does not hold it."""
    deviation, kinds = observations.voltage_sd_v, _kinds(observations)
    if deviation is None:
        return np.ones(len(observations))
    middle = [_middle(deviation[kinds == kind]) for kind in range(kinds.max(initial=0) + 1)]
    usual = np.array(middle)[kinds]
    return np.asarray(
        np.divide(deviation, usual, out=np.ones(len(deviation)), where=(usual > 0) & ~np.isnan(deviation))
    )


def _middle(values: FloatArray) -> float:
    """Median of those that are known; 0 where none is."""
    known = values[~np.isnan(values)]
    return float(np.median(known)) if len(known) else 0.0


def _beyond_chance(standardised: FloatArray) -> bool:
    from scipy.special import chdtrc  # takes a tenth of a second, in which a window is half up

    return bool(chdtrc(len(standardised) - 1, float(standardised @ standardised)) < UNEQUAL_P)


def robust_weights(observations: Observations, residual_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """The same while gross errors are still among the rows: of each kind they count as three robust deviations."""
    kinds = _kinds(observations)
    middle_v = np.array([np.median(np.abs(residual_v[kinds == kind])) for kind in range(kinds.max(initial=0) + 1)])
    limit_v = _ROBUST * middle_v[kinds]
    return dwell_weights(observations, np.clip(residual_v, -limit_v, limit_v), groups)


def weights_of_all(observations: Observations, used: Observations, weights: FloatArray) -> FloatArray:
    """Weights of all rows of a table by those of the rows in use, others as the calm ones of their kind, or 1."""
    kinds, known = _kinds(observations), np.isin(observations.row, used.row)
    of_kind = np.zeros(int(kinds.max(initial=0)) + 1)
    np.maximum.at(of_kind, kinds[known], weights)
    of_kind[of_kind == 0.0] = 1.0
    of_all = of_kind[kinds]
    of_all[known] = weights
    return np.asarray(of_all)


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
