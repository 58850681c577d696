"""Repeats of the same pose, and the pure error that their scatter gives."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.geometry import FloatArray
from tumble.calibrations.observations import Observations

SAME_ANGLE_DEG = 0.02
"""Head angles closer than this are one setting; a motorised head comes to rest within a few thousandths of a degree."""
UNEQUAL_P = 1e-3
"""Kinds of dwell are weighted differently only where their repeats differ beyond this chance."""


def settings(values: FloatArray, same: float = SAME_ANGLE_DEG) -> NDArray[np.int64]:
    """Number of the setting of each row, ascending; values (angles in degrees) closer than `same` share one."""
    order = np.argsort(values, kind="stable")
    number = np.empty(len(values), dtype=np.int64)
    number[order] = np.cumsum(np.diff(values[order], prepend=values[order[:1]]) > same)
    return number


def labels(*columns: NDArray[np.generic]) -> NDArray[np.int64]:
    """Number of the group of each row; rows agree in every column within a group."""
    number = np.zeros(len(columns[0]), dtype=np.int64)
    for column in columns:
        _, inverse = np.unique(column, return_inverse=True)
        _, number = np.unique(number * (inverse.max(initial=0) + 1) + inverse, return_inverse=True)
    return number


def pose_groups(observations: Observations) -> NDArray[np.int64]:
    """Number of the pose of each row: same procedure, mount, head setting and direction of approach."""
    columns: list[NDArray[np.generic]] = [observations.mounts, settings(observations.angle_deg)]
    if observations.procedure is not None:
        columns.append(observations.procedure)
    if observations.direction is not None:
        columns.append(observations.direction)
    return labels(*columns)


def distinct_settings(observations: Observations) -> NDArray[np.int64]:
    """Number of the setting of each row: same mount, and same head angle modulo a turn."""
    turned_deg = observations.true_angle_deg % 360.0
    angle = settings(turned_deg)
    if angle.max(initial=0) and turned_deg.max() - turned_deg.min() > 360.0 - SAME_ANGLE_DEG:
        angle = np.where(angle == angle[np.argmax(turned_deg)], angle[np.argmin(turned_deg)], angle)
    return labels(observations.mounts, angle)


def visits(values: FloatArray, realisation: NDArray[np.int64], parts: int = 12) -> NDArray[np.int64]:
    """Number of the visit of each row: rows in one of the equal parts of the range, in one go and one realisation."""
    span = float(np.ptp(values))
    part = np.minimum((values - values.min()) / (span or 1.0) * parts, parts - 1).astype(np.int64)
    return np.cumsum((np.diff(part, prepend=-1) != 0) | (np.diff(realisation, prepend=-1) != 0)) - 1


def mountings(observations: Observations) -> NDArray[np.int64]:
    """Number of the mounting of each row, from 0: an unbroken sequence of rows with one mount, in one run."""
    mounts, runs = observations.mounts, observations.runs
    seated = (mounts[1:] != mounts[:-1]) | (runs[1:] != runs[:-1])
    return np.concatenate([[0], np.cumsum(seated)])[: len(mounts)].astype(np.int64)


@dataclass(frozen=True, kw_only=True)
class PureError:
    """Pooled variance of one dwell mean between repeats."""

    variance: float
    """In the square of the unit of the values; NaN without repeats."""
    degrees_of_freedom: int

    @property
    def standard_deviation(self) -> float:
        """Scatter of one dwell mean between repeats, in the unit of the values."""
        return float(np.sqrt(self.variance))


def pure_error(values: FloatArray, groups: NDArray[np.int64], weights: FloatArray) -> PureError:
    """Pooled weighted variance of `values` within `groups`; a row of weight w has the variance / w."""
    total = np.bincount(groups, weights)
    mean = np.bincount(groups, weights * values) / np.where(total > 0, total, 1.0)
    freedom = len(values) - int(np.count_nonzero(total))
    squares = float(np.sum(weights * (values - mean[groups]) ** 2))
    return PureError(variance=squares / freedom if freedom else float("nan"), degrees_of_freedom=freedom)


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
