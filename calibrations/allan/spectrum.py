"""What a spectrum of noise gives for the Allan variance, and how the estimates at several averaging times scatter.

An estimate is a sum over frequencies, and the power at each is independent of the others: from it come the covariance
of the estimates, without which coefficients fitted to them have no uncertainty, and other recordings of the same noise.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

_SINGLE: Final = 512
"""So many lines of the spectrum are counted one by one from the lowest; above, they are taken in bands."""
_BANDS: Final = 3000


@dataclass(frozen=True, kw_only=True)
class Lines:
    """Frequencies of a recording, and by how much the power at each adds to the variance at each averaging time."""

    frequency_hz: FloatArray
    """Shape (lines,)."""
    count: FloatArray
    """Lines of the recording that each stands for, shape (lines,)."""
    gains_hz: FloatArray
    """Shape (times, lines); variance = gains × power."""

    def covariance(self, power: FloatArray) -> FloatArray:
        """Covariance of the estimated variances, shape (times, times)."""
        return np.asarray((self.gains_hz * (power**2 / self.count)) @ self.gains_hz.T)

    def drawn(self, power: FloatArray, recordings: int, random: np.random.Generator) -> FloatArray:
        """Variances that other recordings of the same noise would give, shape (recordings, times)."""
        chance = random.gamma(self.count, 1.0 / self.count, (recordings, len(self.count)))
        return np.asarray((chance * power) @ self.gains_hz.T)


def lines(samples: int, rate_hz: float, averages: list[int]) -> Lines:
    """The spectral lines of a recording of so many samples."""
    edges = _edges(samples // 2)
    count = np.diff(edges)
    frequency_hz = 0.5 * (edges[:-1] + edges[1:]) * rate_hz / samples
    times = np.asarray(averages, dtype=float)[:, np.newaxis]
    angle = np.pi * frequency_hz / rate_hz
    response = np.sin(times * angle) ** 4 / (times * np.sin(angle)) ** 2
    return Lines(frequency_hz=frequency_hz, count=count, gains_hz=4.0 * response * count * rate_hz / samples)


def _edges(most: int) -> FloatArray:
    """Numbers of the first line of each band, ascending."""
    if most <= _SINGLE:
        return np.arange(most + 1.0)
    above = np.unique(np.round(np.geomspace(_SINGLE, most, _BANDS)))
    return np.concatenate([np.arange(float(_SINGLE)), above])
