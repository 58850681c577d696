"""Weights of the channels: how much each scatters, by what is known before any fit."""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels, pure_error
from tumble.calibrations.methods.triad.observations import TriadObservations

_ENOUGH = 10
"""Degrees of freedom of the repeats from which on their scatter is a weight."""


def channel_weights(observations: TriadObservations) -> FloatArray:
    """Relative weight of each channel, shape (3,), their geometric mean 1.

    From the scatter of the samples over the root of their number, where the table has both for every channel; else from
    the scatter of repeats; else equal. Weights taken from the residuals of a single pass cost more than they gain.
    """
    variances = _by_samples(observations)
    if variances is None:
        variances = _by_repeats(observations)
    if variances is None:
        return np.ones(3)
    weights = 1.0 / variances
    return np.asarray(weights / np.exp(np.mean(np.log(weights))))


def _by_samples(observations: TriadObservations) -> FloatArray | None:
    """Variance of a dwell mean of each channel by its samples; None where that is not known of all."""
    samples = observations.samples
    pooled = []
    for deviation_v in observations.sample_deviations_v():
        if samples is None or deviation_v is None or not np.isfinite(deviation_v).any():
            return None
        pooled.append(float(np.nanmean(deviation_v**2 / samples)))
    return np.array(pooled) if min(pooled) > 0 else None


def _by_repeats(observations: TriadObservations) -> FloatArray | None:
    """The same by repeats of a position, each realisation's mean apart; None where there are too few of them."""
    rows = len(observations)
    realisation = labels(observations.realisations)
    found = []
    for output_v in observations.outputs_v.T:
        mean_v = np.bincount(realisation, output_v) / np.bincount(realisation)
        error = pure_error(output_v - mean_v[realisation], observations.positions, np.ones(rows))
        if error.degrees_of_freedom < _ENOUGH or not error.variance > 0:
            return None
        found.append(error.variance)
    return np.array(found)
