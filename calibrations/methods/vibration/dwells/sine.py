"""Offset, harmonics and frequency of a dwell, fitted together to all of its channels.

A least-squares fit with several harmonics is free of what a cut period does to a plain mean, of missing samples and of
a drive that is off its nominal frequency (IEEE Std 1057-2017, 4.7: four-parameter fit, here for several harmonics and
for channels that share the frequency).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.dwells.long_run import widening
from tumble.calibrations.tracing.fitting_noise import golden_section

FEWEST_HARMONICS: Final = 2
"""The second harmonic is what rectification itself makes."""
MOST_HARMONICS: Final = 5
_BELIEVED: Final = 15.0
"""Fall of -2 ln L from which on a harmonic is believed: chi-square with two degrees of freedom, chance 5e-4."""
_WITHIN: Final = 0.05
"""The drive is looked for so far about its nominal frequency, and half a line of the spectrum at least."""
_PER_LINE: Final = 8
"""Frequencies that are tried for each line of the spectrum."""
_MOST_TRIED: Final = 400


@dataclass(frozen=True, kw_only=True)
class SineFit:
    """One channel of a dwell."""

    offset: float
    offset_uncertainty: float
    """Standard, the frequency fitted too, widened where the residuals are autocorrelated."""
    phasors: FloatArray
    """Complex amplitudes of the harmonics, the fundamental first, shape (harmonics,): x = Σ Re p exp(2πi h f t)."""
    residual: FloatArray
    """Shape (samples,)."""

    @property
    def amplitude(self) -> float:
        """Of the fundamental."""
        return float(abs(self.phasors[0]))


@dataclass(frozen=True, kw_only=True)
class DwellFit:
    """All channels of a dwell."""

    frequency_hz: float
    frequency_uncertainty_hz: float
    channels: tuple[SineFit, ...]


def fit_sines(time_s: FloatArray, channels: Sequence[FloatArray], nominal_hz: float) -> DwellFit:
    """Fit channels that vibrate with one frequency near the nominal one; times and channels of shape (samples,).

    Phases are those at the middle of the times. A channel has as many harmonics as it shows, two at least.
    """
    away_s = time_s - (time_s[0] + time_s[-1]) / 2.0
    start_hz = _nearest(away_s, channels[-1] if len(channels) > 1 else channels[0], nominal_hz)
    found = _refined(away_s, channels, [FEWEST_HARMONICS] * len(channels), start_hz)
    counts = [_harmonics(away_s, each, found) for each in channels]
    found = _refined(away_s, channels, counts, found)
    return _fitted(away_s, channels, counts, found)


def fitted_at(away_s: FloatArray, channel: FloatArray, frequency_hz: float) -> SineFit:
    """One channel at a frequency that is known; times from the middle of the dwell."""
    return _channel(away_s, channel, _harmonics(away_s, channel, frequency_hz), frequency_hz, np.inf)


def _columns(away_s: FloatArray, frequency_hz: float, harmonics: int) -> FloatArray:
    """One, then a cosine and a sine for each harmonic, shape (samples, 1 + 2 harmonics)."""
    phase = 2.0 * np.pi * frequency_hz * away_s
    waves = [wave(order * phase) for order in range(1, harmonics + 1) for wave in (np.cos, np.sin)]
    return np.column_stack([np.ones(len(away_s)), *waves])


def _solved(columns: FloatArray, channel: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Coefficients and residual; by normal equations, which are well conditioned for waves."""
    coefficients: FloatArray = np.linalg.lstsq(columns.T @ columns, columns.T @ channel, rcond=1e-12)[0].astype(float)
    return coefficients, np.asarray(channel - columns @ coefficients)


def _nearest(away_s: FloatArray, channel: FloatArray, nominal_hz: float) -> float:
    """The frequency near the nominal one at which a sine with an offset leaves least."""
    line_hz = 1.0 / float(np.ptp(away_s))
    within_hz = max(_WITHIN * nominal_hz, 0.5 * line_hz)
    step_hz = max(line_hz / _PER_LINE, 2.0 * within_hz / _MOST_TRIED)
    tried = np.arange(max(nominal_hz - within_hz, 0.1 * line_hz), nominal_hz + within_hz + step_hz, step_hz)
    if step_hz > line_hz / 2:
        tried = tried[_strongest(away_s, channel, tried)]
        tried = np.arange(tried[0] - step_hz, tried[0] + step_hz, line_hz / _PER_LINE)
    left = [float(np.sum(_solved(_columns(away_s, each, 1), channel)[1] ** 2)) for each in tried.tolist()]
    return float(tried[int(np.argmin(left))])


def _strongest(away_s: FloatArray, channel: FloatArray, tried: FloatArray) -> FloatArray:
    """Where among coarse steps the line of the spectrum is: by stretches so short that each step sees it."""
    step_hz = float(tried[1] - tried[0])
    short = np.abs(away_s) < 0.5 / step_hz
    power = np.abs(np.exp(-2j * np.pi * np.outer(tried, away_s[short])) @ (channel - channel.mean())[short])
    return np.asarray([int(np.argmax(power))])


def _refined(away_s: FloatArray, channels: Sequence[FloatArray], counts: Sequence[int], start_hz: float) -> float:
    """The frequency at which all channels together leave least, each weighed by its noise."""
    span_hz = 0.5 / float(np.ptp(away_s))
    noise = [
        float(np.sum(_solved(_columns(away_s, start_hz, count), each)[1] ** 2)) or 1.0
        for each, count in zip(channels, counts, strict=True)
    ]

    def left(trial_hz: float) -> float:
        squares = (
            float(np.sum(_solved(_columns(away_s, trial_hz, count), each)[1] ** 2))
            for each, count in zip(channels, counts, strict=True)
        )
        logarithms = [np.log(square / scale + 1e-30) for square, scale in zip(squares, noise, strict=True)]
        return len(away_s) * float(np.sum(logarithms))

    best = golden_section(left, start_hz - span_hz, start_hz + span_hz, steps=16)
    for _ in range(2):  # Gauss and Newton from there
        best += _step(away_s, channels, counts, best)
    return best


def _step(away_s: FloatArray, channels: Sequence[FloatArray], counts: Sequence[int], frequency_hz: float) -> float:
    """Step of the frequency by the channels together, each weighed by its own residual."""
    known = [_information(away_s, each, count, frequency_hz) for each, count in zip(channels, counts, strict=True)]
    whole = sum(information for information, _ in known)
    return sum(slope for _, slope in known) / whole if whole > 0.0 else 0.0


def _information(away_s: FloatArray, channel: FloatArray, harmonics: int, frequency_hz: float) -> tuple[float, float]:
    """What a channel knows of the frequency, 1/Hz², and that times the step it asks for."""
    columns = _columns(away_s, frequency_hz, harmonics)
    coefficients, residual = _solved(columns, channel)
    change = _change(away_s, columns, coefficients)
    beside = _solved(columns, change)[1]
    variance = max(float(np.mean(residual**2)), 1e-300)
    return float(beside @ beside) / variance, float(beside @ residual) / variance


def _change(away_s: FloatArray, columns: FloatArray, coefficients: FloatArray) -> FloatArray:
    """Derivative of a channel with respect to the frequency, shape (samples,)."""
    orders = np.arange(1, columns.shape[1] // 2 + 1)
    cosines, sines = coefficients[1::2], coefficients[2::2]
    turned = columns[:, 1::2] @ (orders * sines) - columns[:, 2::2] @ (orders * cosines)
    return np.asarray(2.0 * np.pi * away_s * turned)


def _harmonics(away_s: FloatArray, channel: FloatArray, frequency_hz: float) -> int:
    """Order of the highest harmonic that a channel shows."""
    rate_hz = 1.0 / float(np.median(np.diff(away_s)))
    most = max((order for order in range(2, MOST_HARMONICS + 1) if 2.2 * order * frequency_hz < rate_hz), default=2)
    squares = [float(np.sum(_solved(_columns(away_s, frequency_hz, n), channel)[1] ** 2)) for n in range(1, most + 1)]
    falls = len(away_s) * -np.diff(np.log(np.maximum(squares, 1e-300)))
    shown = np.flatnonzero(falls > _BELIEVED) + 2
    return int(shown.max(initial=FEWEST_HARMONICS))


def _fitted(away_s: FloatArray, channels: Sequence[FloatArray], counts: Sequence[int], frequency_hz: float) -> DwellFit:
    known = [_information(away_s, each, n, frequency_hz)[0] for each, n in zip(channels, counts, strict=True)]
    whole = sum(known)
    return DwellFit(
        frequency_hz=frequency_hz,
        frequency_uncertainty_hz=1.0 / float(np.sqrt(whole)) if whole > 0.0 else np.inf,
        channels=tuple(
            _channel(away_s, each, n, frequency_hz, whole - own)
            for each, n, own in zip(channels, counts, known, strict=True)
        ),
    )


def _channel(away_s: FloatArray, channel: FloatArray, harmonics: int, frequency_hz: float, known: float) -> SineFit:
    """One channel; `known` is what the others know of the frequency, in 1/Hz²."""
    columns = _columns(away_s, frequency_hz, harmonics)
    coefficients, residual = _solved(columns, channel)
    freedom = max(len(channel) - columns.shape[1] - 1, 1)
    variance = float(residual @ residual) / freedom
    known_too = [] if np.isinf(known) else [_change(away_s, columns, coefficients)]
    whole = np.column_stack([columns, *known_too])
    information = whole.T @ whole
    if known_too:
        information[-1, -1] += known * variance
    scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
    covariance = variance * np.linalg.pinv(information / np.outer(scale, scale)) / np.outer(scale, scale)
    return SineFit(
        offset=float(coefficients[0]),
        offset_uncertainty=float(np.sqrt(covariance[0, 0])) * widening(residual),
        phasors=np.asarray(coefficients[1::2] - 1j * coefficients[2::2]),
        residual=residual,
    )
