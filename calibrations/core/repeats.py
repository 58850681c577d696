"""Repeats of the same pose, and the pure error that their scatter gives."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray

SAME_ANGLE_DEG = 0.02
"""Head angles closer than this are one setting; a motorised head comes to rest within a few thousandths of a degree."""


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


def visits(values: FloatArray, realisation: NDArray[np.int64], parts: int = 12) -> NDArray[np.int64]:
    """Number of the visit of each row: rows in one of the equal parts of the range, in one go and one realisation."""
    span = float(np.ptp(values))
    part = np.minimum((values - values.min()) / (span or 1.0) * parts, parts - 1).astype(np.int64)
    return np.cumsum((np.diff(part, prepend=-1) != 0) | (np.diff(realisation, prepend=-1) != 0)) - 1


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


def without_levels(values: FloatArray, groups: NDArray[np.int64], level: NDArray[np.int64]) -> FloatArray:
    """Values without what all groups differ by from one level to the next: least squares of groups and levels."""
    each, width = np.ones(len(values)), int(level.max(initial=-1)) + 1
    visits = np.bincount(groups * width + level, minlength=(int(groups.max(initial=-1)) + 1) * width).reshape(-1, width)
    part = visits / visits.sum(axis=1, keepdims=True).clip(1)
    of_level, of_group = np.bincount(level, values, width), np.bincount(groups, values, len(visits))
    beside = np.diag(np.bincount(level, each, width)) - visits.T @ part
    shift = np.linalg.lstsq(beside, of_level - part.T @ of_group, rcond=1e-9)[0]
    return np.asarray(values - shift[level])
