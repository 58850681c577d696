"""Uncertainty of the mean of samples whose noise is autocorrelated."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

_MOST_ORDER: Final = 24
"""Highest order of the autoregression that is tried."""


def widening(residual: FloatArray) -> float:
    """By how much the autocorrelation of residuals widens the uncertainty of their mean; 1 where they are white.

    Root of the spectral density at zero frequency over the variance, by an autoregression whose order is that of the
    lowest Bayesian information criterion (Priestley, Spectral Analysis and Time Series, 7.8): for white residuals that
    is no order at all. Noise that falls towards zero frequency narrows nothing.
    """
    count = len(residual)
    covariances = _autocovariances(residual - residual.mean(), min(_MOST_ORDER, count // 10))
    if not covariances[0] > 0.0:
        return 1.0
    best, density = count * np.log(covariances[0]), covariances[0]
    coefficients, variance = np.empty(0), covariances[0]
    for order in range(1, len(covariances)):  # Levinson and Durbin
        reflection = (covariances[order] - coefficients @ covariances[order - 1 : 0 : -1]) / variance
        coefficients = np.append(coefficients - reflection * coefficients[::-1], reflection)
        variance = variance * (1.0 - reflection**2)
        criterion = count * np.log(variance) + order * np.log(count)
        if criterion < best:
            best, density = criterion, variance / max(1.0 - coefficients.sum(), 1e-3) ** 2
    return float(np.sqrt(max(density / covariances[0], 1.0)))


def _autocovariances(centred: FloatArray, lags: int) -> FloatArray:
    count = len(centred)
    return np.array([centred[: count - lag] @ centred[lag:] / count for lag in range(lags + 1)])


def mean_uncertainty(residual: FloatArray, fitted: int = 1) -> float:
    """Standard uncertainty of the mean of samples, of which so many parameters were fitted."""
    count = len(residual)
    return float(np.sqrt(np.sum(residual**2) / max(count - fitted, 1) / count)) * widening(residual)
