"""Finds gross errors: single rows that agree neither with the model nor with their own repeats."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.best_alpha0 import best_parameters
from tumble.calibrations.methods.dividing_head.model import coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings
from tumble.calibrations.methods.dividing_head.weights import robust_weights
from tumble.messages import Message

_HUBER = 1.345
"""Tuning of Huber's weights: 95% efficient on normal noise (Huber and Ronchetti, Robust Statistics, 4.5)."""


def gross_errors(
    observations: Observations, basis: FloatArray, groups: NDArray[np.int64], fitted: int
) -> tuple[SetAside, ...]:
    """Rows to set aside, each with the reason. A kind of dwell that scatters more has wider limits.

    `basis` are the ten functions of the declared model, shape (rows, 10); `groups` are the poses, `fitted` the number
    of parameters. Where a pose was visited more than once, a row must also differ from the median of the other visits:
    what comes back at every visit is no gross error but structure.
    """
    residual = robust_residual(basis, observations.output_v)
    weighted = residual * np.sqrt(robust_weights(observations, residual, groups))
    return unlike_repeats(observations, weighted, groups, _scale(weighted, fitted), len(residual) - fitted)


def unlike_repeats(
    observations: Observations,
    residual_v: FloatArray,
    groups: NDArray[np.int64],
    scale_v: float,
    spare_rows: int,
) -> tuple[SetAside, ...]:
    """Rows whose residual is far too large, and differs as much from the repeats of the pose.

    The residuals are weighted: times the root of the weight of their row.

    Where all rows of a mounting are off, each by half as much at least, the seat is, and they are kept.
    """
    limit_v = gross_sigmas(spare_rows) * scale_v
    suspects = np.abs(residual_v) > limit_v
    mounting = mountings(observations)
    visits = np.bincount(mounting)
    seat_off = (np.bincount(mounting, np.abs(residual_v) > limit_v / 2) == visits) & (visits > 1)
    return tuple(
        SetAside(
            row=int(observations.row[row]),
            reason=Message("gross error: {sigmas:.0f} sigma", sigmas=abs(residual_v[row]) / scale_v),
            gross=True,
        )
        for row in np.flatnonzero(suspects & ~seat_off[mounting]).tolist()
        if _differs_from_repeats(row, residual_v, groups, limit_v)
    )


def _scale(residual: FloatArray, fitted: int) -> float:
    """Robust standard deviation: the median absolute deviation, made unbiased for normal noise."""
    rows = len(residual)
    freedom = max(rows - fitted, 1)
    return max(float(1.4826 * np.median(np.abs(residual)) * np.sqrt(rows / freedom)), 1e-12)


def robust_residual(basis: FloatArray, voltage_v: FloatArray) -> FloatArray:
    """Residual of Huber's M-estimate of the declared model, by reweighting.

    `basis` are its ten functions, shape (rows, 10). alpha0 holds them together here: with ten free coefficients, a
    function that vanishes at all rows but a gross error would take that for its own.
    """
    weights = np.ones(len(voltage_v))
    residual = voltage_v
    for _ in range(30):
        theta = best_parameters(compress(basis, voltage_v, weights))
        residual = voltage_v - basis @ coefficients(theta)
        limit = _HUBER * _scale(residual, 0)
        previous, weights = weights, np.minimum(1.0, limit / np.maximum(np.abs(residual), limit))
        if np.abs(weights - previous).max(initial=0.0) < 1e-3:
            break
    return np.asarray(residual)


def _differs_from_repeats(row: int, residual: FloatArray, groups: NDArray[np.int64], limit_v: float) -> bool:
    others = np.flatnonzero(groups == groups[row])
    others = others[others != row]
    return not len(others) or bool(abs(residual[row] - np.median(residual[others])) > limit_v)
