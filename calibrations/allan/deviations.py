"""Overlapping Allan deviation with confidence bands and the kind of noise at each averaging time, by `allantools`.

Three things of that library are not taken as they come: its errors, which count overlapping differences as independent
ones; its intervals, whose level is 68% unless told; and its kind of noise, which takes thirty averages to be known:
beyond, the last one that was known is kept (Riley, NIST SP 1065, 5.5.3).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import allantools
import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message

LEVEL: Final = 0.95
FEWEST_SAMPLES: Final = 256
LONGEST_PART: Final = 4
"""The longest averaging time is this part of the recording: beyond, hardly anything is left to be averaged."""
_FEWEST_AVERAGES: Final = 30
_STEEPEST: Final = -2
"""Exponent of a random walk; what is steeper has the bands of one, the widest there are."""

NOISE_TYPES: Final = {
    2: Message("white phase noise"),
    1: Message("flicker phase noise"),
    0: Message("white noise"),
    -1: Message("flicker"),
    -2: Message("random walk"),
}
"""By the exponent α of the spectrum, S ~ f^α; below is drift."""
DRIFT: Final = Message("drift")


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """The Allan deviation at one averaging time, in the unit of the output."""

    tau_s: float
    value: float
    low: float
    high: float
    """Ends of the 95% interval."""
    degrees_of_freedom: float
    alpha: int
    """Exponent of the spectrum of the noise there."""

    @property
    def noise(self) -> Message:
        """The kind of noise at this averaging time."""
        return NOISE_TYPES.get(self.alpha, DRIFT)


def deviations(values: FloatArray, rate_hz: float) -> tuple[Deviation, ...]:
    """The deviation at averaging times that double from one sample to a quarter of the recording."""
    tau_s, found = deviation_at(values, rate_hz, doubling(len(values)))
    return tuple(_with_bands(values, rate_hz, tau_s, found))


def deviation_at(values: FloatArray, rate_hz: float, averages: list[int]) -> tuple[FloatArray, FloatArray]:
    """Averaging times in s and deviations for so many samples averaged."""
    asked_s = np.asarray(averages) / rate_hz
    centred = values - values.mean()
    tau_s, found, _, _ = allantools.oadev(centred, rate=rate_hz, data_type="freq", taus=asked_s)
    return np.asarray(tau_s), np.asarray(found)


def doubling(samples: int) -> list[int]:
    """Numbers of samples to average that double up to a quarter of the recording."""
    return [2**power for power in range(int(np.log2(samples // LONGEST_PART)) + 1)]


def dense(samples: int) -> list[int]:
    """The same with eight in each doubling."""
    longest = samples // LONGEST_PART
    steps = 2.0 ** np.arange(0.0, np.log2(longest) + 1e-9, 1.0 / 8.0)
    return [*dict.fromkeys([*np.round(steps).astype(int).tolist(), longest])]


def _with_bands(values: FloatArray, rate_hz: float, tau_s: FloatArray, found: FloatArray) -> Iterator[Deviation]:
    alpha = 0
    for each_s, value in zip(tau_s.tolist(), found.tolist(), strict=True):
        averages = round(each_s * rate_hz)
        if value > 0.0 and len(values) // averages >= _FEWEST_AVERAGES:
            alpha = min(int(allantools.autocorr_noise_id(values, averages, data_type="freq")[0]), 2)
        freedom = float(allantools.edf_greenhall(max(alpha, _STEEPEST), 2, averages, len(values) + 1, overlapping=True))
        low, high = allantools.confidence_interval(value, freedom, ci=LEVEL)
        yield Deviation(
            tau_s=each_s, value=value, low=float(low), high=float(high), degrees_of_freedom=freedom, alpha=alpha
        )
