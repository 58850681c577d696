"""Dwells under random vibration: mean squares, covariance, and how far they are from those of the spectrum."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.dwells.long_run import mean_uncertainty
from tumble.calibrations.methods.vibration.dwells.samples import Samples

_SEGMENTS: Final = 16
"""Of a spectrum, half overlapping."""
_LINE: Final = 0.5
"""A sine holds more than this part of the power of a spectrum in three of its lines."""


@dataclass(frozen=True, kw_only=True)
class BroadbandFit:
    """A dwell under random vibration."""

    mean_g: float
    """Of the output, without what the mean of the vibration itself adds to it."""
    mean_uncertainty_g: float
    ii_g2: float | None
    oo_g2: float | None
    io_g2: float | None
    ii_uncertainty_g2: float | None


def fit_broadband(samples: Samples, noise: Sequence[float]) -> BroadbandFit:
    """Reduce a dwell; `noise` is the variance of each reference at rest.

    The output follows the references sample by sample; what their mean over the dwell adds is taken off, because a
    motion that is bounded has no mean acceleration and that of a stretch is an accident.
    """
    centred = [each - each.mean() for each in samples.references_g]
    columns = np.column_stack([np.ones(len(samples.time_s)), *centred])
    coefficients = np.linalg.lstsq(columns, samples.output_g, rcond=None)[0]
    residual = samples.output_g - columns @ coefficients
    own = [*noise, 0.0, 0.0]
    products = np.cov(np.vstack(centred), bias=True).reshape(len(centred), -1) if centred else np.empty((0, 0))
    several = len(centred) > 1
    return BroadbandFit(
        mean_g=float(coefficients[0]) - _accident(samples, coefficients[1:]),
        mean_uncertainty_g=mean_uncertainty(residual, columns.shape[1]),
        ii_g2=float(products[0, 0]) - own[0] if centred else None,
        oo_g2=float(products[1, 1]) - own[1] if several else None,
        io_g2=float(products[0, 1]) if several else None,
        ii_uncertainty_g2=_spread(centred[0], samples.step_s) if centred else None,
    )


def _accident(samples: Samples, coefficients: FloatArray) -> float:
    """What the mean of the vibration over the dwell adds to the output; a reference has no offset of its own here."""
    return float(sum(each.mean() * size for each, size in zip(samples.references_g, coefficients, strict=True)))


def spectrum(values: FloatArray, step_s: float) -> tuple[FloatArray, FloatArray]:
    """Frequencies in Hz and one-sided power spectral density in g²/Hz (Welch, Hann window)."""
    from scipy.signal import welch  # takes a quarter of a second

    length = max(2 * len(values) // (_SEGMENTS + 1), 8)
    frequency_hz, density = welch(values - values.mean(), fs=1.0 / step_s, nperseg=length)
    return np.asarray(frequency_hz), np.asarray(density)


def _spread(values: FloatArray, step_s: float) -> float:
    """Standard deviation of a mean square: root of ∫ G² df / T (Bendat and Piersol, Random Data, 8.2)."""
    frequency_hz, density = spectrum(values, step_s)
    overlap = 1.0 / (1.0 + 1.0 / _SEGMENTS)  # squares of an estimated density are too large by its own variance
    squares = float(np.trapezoid(density**2, frequency_hz)) * overlap
    return float(np.sqrt(squares / (len(values) * step_s)))


def has_line(samples: Samples) -> float:
    """Frequency of the sine that a dwell without a nominal frequency is vibrated with; 0 where there is none."""
    channel = samples.references_g[0] if samples.references_g else samples.output_g
    power = np.abs(np.fft.rfft((channel - channel.mean()) * np.hanning(len(channel)))) ** 2
    top = int(np.argmax(power))
    if power[max(top - 1, 0) : top + 2].sum() < _LINE * power.sum():
        return 0.0
    return top / (len(channel) * samples.step_s)
