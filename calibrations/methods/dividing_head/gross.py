"""Finds gross errors: single rows that agree neither with the model nor with their own repeats."""

from collections.abc import Collection, Iterator

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.gross import burst, gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.best_alpha0 import quick_parameters
from tumble.calibrations.methods.dividing_head.model import coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings
from tumble.calibrations.methods.dividing_head.weights import robust_weights
from tumble.messages import Message

_HUBER = 1.345
"""Tuning of Huber's weights: 95% efficient on normal noise (Huber and Ronchetti, Robust Statistics, 4.5)."""

_GOOD_PART = 0.2
"""Beyond that part of a realisation, and beyond `_A_FEW` rows, they are no single errors."""
_A_FEW = 4


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
    seat_off = _seat_off(mountings(observations), np.abs(residual_v) > limit_v / 2)
    gross, doubtful = (
        (np.abs(residual_v) > limit) & ~seat_off & _differ_from_repeats(residual_v, groups, limit)
        for limit in (limit_v, limit_v / 2)
    )
    return tuple(
        SetAside(
            row=int(observations.row[row]),
            reason=_reason(bool(gross[row]), abs(residual_v[row]) / scale_v),
            gross=True,
        )
        for row in np.flatnonzero(burst(gross, doubtful, observations.time_s) & ~seat_off).tolist()
    )


def disturbed_realisations(observations: Observations, rejected: Collection[SetAside]) -> Iterator[Message]:
    """A sentence on every one of several realisations of which a good part is among the rows to be set aside."""
    if observations.realisation is None or len(np.unique(observations.realisation)) < 2:
        return
    out = np.isin(observations.row, [entry.row for entry in rejected])
    for number in np.unique(observations.realisation[out]).tolist():
        of_it = observations.realisation == number
        aside, rows = int(np.count_nonzero(out & of_it)), int(np.count_nonzero(of_it))
        if aside > max(_A_FEW, _GOOD_PART * rows):
            yield Message(
                "{source}: realisation {number} was disturbed as a whole ({part:.0%} of it stands out as gross "
                "errors); measure it again",
                source=observations.source,
                number=number,
                part=aside / rows,
            )


def _reason(alone: bool, sigmas: float) -> Message:
    if alone:
        return Message("gross error: {sigmas:.0f} sigma", sigmas=sigmas)
    return Message("in a burst of gross errors: {sigmas:.0f} sigma", sigmas=sigmas)


def _seat_off(mounting: NDArray[np.int64], off: BoolArray) -> BoolArray:
    """Rows of mountings with several rows all of which are off."""
    visits = np.bincount(mounting)
    return np.asarray(((np.bincount(mounting, off) == visits) & (visits > 1))[mounting])


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
        theta = quick_parameters(compress(basis, voltage_v, weights))
        residual = voltage_v - basis @ coefficients(theta)
        limit = _HUBER * _scale(residual, 0)
        previous, weights = weights, np.minimum(1.0, limit / np.maximum(np.abs(residual), limit))
        if np.abs(weights - previous).max(initial=0.0) < 1e-3:
            break
    return np.asarray(residual)


def _differ_from_repeats(residual: FloatArray, groups: NDArray[np.int64], limit_v: float) -> BoolArray:
    """Of rows beyond a limit those that are as far from the median of the other visits of their pose, or have none."""
    differ = np.ones(len(residual), dtype=bool)
    for row in np.flatnonzero(np.abs(residual) > limit_v).tolist():
        others = np.flatnonzero(groups == groups[row])
        others = others[others != row]
        differ[row] = not len(others) or abs(residual[row] - np.median(residual[others])) > limit_v
    return differ
