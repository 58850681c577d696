"""Weights of the rows by the stated uncertainties of their means."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.methods.vibration.observations import VibrationObservations

_ALIKE: Final = 1.25
"""Conditions whose pooled uncertainties differ by a smaller ratio differ by chance."""
_OWN: Final = 2.0
"""A row that is further from its condition by a larger ratio has an uncertainty of its own."""


def row_weights(rows: VibrationObservations) -> FloatArray:
    """Relative weight of each row, shape (rows,), their geometric mean 1.

    A stated uncertainty is an estimate too, by the scatter of one dwell: as it stands it costs efficiency (6% of
    variance where it scatters by 12%). So it is pooled over the dwells of a condition, rest or kind of vibration and
    level, and over all of these where they agree.
    """
    said = rows.output_u_ug
    if said is None or not np.all(np.isfinite(said) & (said > 0.0)):
        return np.ones(len(rows))
    variance = said**2
    condition = labels(rows.random.astype(float), np.round(rows.level, 3))
    pooled = np.asarray(np.bincount(condition, variance) / np.bincount(condition), dtype=float)
    if pooled.max() < _ALIKE**2 * pooled.min() or _by_chance(variance, condition):
        pooled = np.full(len(pooled), float(variance.mean()))
    its = pooled[condition]
    far = (variance > _OWN**2 * its) | (variance < its / _OWN**2)
    weights = 1.0 / np.where(far, variance, its)
    return np.asarray(weights / np.exp(np.mean(np.log(weights))))


def _by_chance(variance: FloatArray, condition: np.ndarray[tuple[int, ...], np.dtype[np.int64]]) -> bool:
    """Whether conditions differ no more than their rows do: one-way analysis of variance of the logarithms."""
    from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

    logarithm, count = np.log(variance), np.bincount(condition)
    mean = np.bincount(condition, logarithm) / count
    inside, outside = len(variance) - len(count), len(count) - 1
    if inside < 1 or outside < 1:
        return False
    within = float(np.sum((logarithm - mean[condition]) ** 2)) / inside
    between = float(np.sum(count * (mean - logarithm.mean()) ** 2)) / outside
    return within > 0.0 and float(fdtrc(outside, inside, between / within)) > 0.01
