"""Random vibration as an arbitrary waveform that is repeated: a sine at every line, with random phases."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.drivers.excitation import Random
from tumble.drivers.protocols import FloatArray

POINTS: Final = 8_192
_PER_HIGHEST: Final = 4.0
"""Points of the waveform in a period of the highest frequency."""
FULL_SCALE: Final = 32_767
"""DAC code of the peak."""


@dataclass(frozen=True, kw_only=True)
class Waveform:
    """A period of random vibration."""

    codes: tuple[int, ...]
    """DAC codes, peak ±32,767."""
    rate_hz: float
    """Points per second."""

    @property
    def rms(self) -> float:
        """R.m.s. value over the peak."""
        return float(np.sqrt(np.mean((np.array(self.codes) / FULL_SCALE) ** 2)))


def waveform_of(excitation: Random, seed: int = 1) -> Waveform:
    """The waveform of a spectral density; the level is left to the amplitude of the output."""
    rate_hz = _PER_HIGHEST * excitation.frequencies_hz[-1]
    hz = np.asarray(np.fft.rfftfreq(POINTS, 1.0 / rate_hz), dtype=np.float64)
    random = np.random.default_rng(seed)
    phases_rad = random.uniform(0.0, 2.0 * np.pi, len(hz))
    values = np.fft.irfft(np.sqrt(_density(excitation, hz)) * np.exp(1j * phases_rad), POINTS)
    codes = np.round(FULL_SCALE * values / np.abs(values).max()).astype(int)
    return Waveform(codes=tuple(codes.tolist()), rate_hz=rate_hz)


def _density(excitation: Random, hz: FloatArray) -> FloatArray:
    """The density at frequencies, 0 outside its band."""
    points_hz = excitation.frequencies_hz
    inside = (hz >= points_hz[0]) & (hz <= points_hz[-1])
    logs = np.interp(np.log(np.maximum(hz, 1e-9)), np.log(points_hz), np.log(excitation.density_g2_hz))
    return np.where(inside, np.exp(logs), 0.0)
