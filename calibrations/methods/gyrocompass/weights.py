"""Weights of rates and tilts: how much each scatters, by what is known before any fit."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels, pure_error
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations

_ENOUGH: Final = 8
"""Degrees of freedom of the repeats from which on their scatter is a weight."""
_UNEVEN: Final = 3.0
"""Deviations of samples that differ by more than so many of their own standard errors are weights of single rows."""


def rate_variances(observations: GyrocompassObservations) -> FloatArray:
    """Relative variance of the rate of each row, shape (rows,), of mean 1.

    By the scatter of the samples over their number, where the table has both; the deviations are pooled unless they
    differ by more than their own uncertainty.
    """
    variance = _by_samples(observations)
    return np.ones(len(observations)) if variance is None else np.asarray(variance / np.mean(variance))


def _by_samples(observations: GyrocompassObservations) -> FloatArray | None:
    deviation, samples = observations.rate_sd_deg_h, observations.samples
    if deviation is None or samples is None or not np.isfinite(deviation).all() or not (deviation > 0).all():
        return None
    unknown = float(np.mean(1.0 / np.sqrt(2.0 * np.maximum(samples - 1, 1))))
    even = float(np.std(np.log(deviation))) < _UNEVEN * unknown
    squares = np.full(len(samples), np.mean(deviation**2)) if even else deviation**2
    return np.asarray(squares / np.maximum(samples, 1))


def rate_variance(observations: GyrocompassObservations) -> float | None:
    """Variance of a mean rate in (°/h)²: by the samples, or by repeats where these say more; None where neither says.

    Repeats are compared within a realisation, so that a drift between these does not count as scatter.
    """
    by_samples = _by_samples(observations)
    repeats = _repeated(observations, observations.rate_deg_h)
    if by_samples is None:
        return repeats
    return max(float(np.mean(by_samples)), 0.0) or repeats


def variance_by_samples(observations: GyrocompassObservations) -> float | None:
    """Mean variance of a mean rate by its samples, in (°/h)²; None where the table lacks them."""
    found = _by_samples(observations)
    return None if found is None else float(np.mean(found))


def tilt_variance(observations: GyrocompassObservations) -> float | None:
    """Variance of the sine of a measured tilt, by repeats; None where there are too few of them."""
    tilt_deg = observations.tilt_gamma_deg
    return None if tilt_deg is None else _repeated(observations, np.sin(np.deg2rad(tilt_deg)))


def _repeated(observations: GyrocompassObservations, values: FloatArray) -> float | None:
    """Scatter between dwells of one position from one side."""
    sides = np.zeros(len(values)) if observations.direction is None else observations.direction
    error = pure_error(values, labels(observations.positions, sides), np.ones(len(values)))
    if error.degrees_of_freedom < _ENOUGH or not error.variance > 0.0:
        return None
    return error.variance
