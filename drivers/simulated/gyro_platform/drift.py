"""How the rate of a gyro wanders: functions of time alone, whatever was asked before."""

import math
from typing import Final

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.gyro_platform.settings import GyroNoise
from tumble.drivers.simulated.noise import RandomWalk, flicker, generator

LEVELLING: Final = 0
AZIMUTH: Final = 1
"""Numbers of the channels, by which their draws are keyed."""
CORRELATED: Final = 101
"""Stream of the draws of a Gauss-Markov process, none of those of `Stream`."""
_APART: Final = 1000
"""So far apart are the seeds of the channels."""


class GaussMarkov:
    """First-order Gauss-Markov process, stationary: `x' = -x/T + noise`.

    Exact at nodes of a grid, `x[k+1] = a x[k] + σ √(1 - a²) ξ[k]` with `a = exp(-h/T)`, and straight between them.
    """

    CHUNK: Final = 4096

    def __init__(self, seed: int, stream: int, *, sd: float, correlation_s: float) -> None:
        self._seed, self._stream, self._sd = seed, stream, sd
        self._step_s = min(1.0, correlation_s / 50.0)
        self._kept = math.exp(-self._step_s / correlation_s)
        self._values = sd * generator(seed, stream).standard_normal(1)

    def at(self, times_s: FloatArray) -> FloatArray:
        """Value at each of the times, which are not negative, in the unit of `sd`."""
        if self._sd == 0.0:
            return 0.0 * times_s
        steps = times_s / self._step_s
        while len(self._values) < steps.max() + 2:
            self._extend()
        return np.interp(steps, np.arange(len(self._values)), self._values)

    def _extend(self) -> None:
        from scipy.signal import lfilter  # takes a second to load: a stand is described without it

        random = generator(self._seed, self._stream, 1 + len(self._values) // self.CHUNK)
        noise = self._sd * math.sqrt(1.0 - self._kept**2) * random.standard_normal(self.CHUNK)
        more, _ = lfilter([1.0], [1.0, -self._kept], noise, zi=[self._kept * self._values[-1]])
        self._values = np.concatenate([self._values, more])


class Wandering:
    """All that wanders in the rate of one channel."""

    def __init__(self, seed: int, channel: int, noise: GyroNoise, random_walk: float) -> None:
        seed = (seed + _APART * channel) % 2**64
        self._parts = (
            GaussMarkov(seed, CORRELATED, sd=noise.gauss_markov_deg_h, correlation_s=noise.correlation_s),
            RandomWalk(seed, v_per_sqrt_h=random_walk),
            flicker(seed, noise.bias_instability_deg_h),
        )

    def at(self, times_s: FloatArray) -> FloatArray:
        """Rate at each of the times since the world began, which rise and are not negative, in °/h."""
        return np.asarray(sum(part.at(times_s) for part in self._parts))


def white_deg_h(noise: GyroNoise, rate_hz: float) -> float:
    """Standard deviation of single samples at a rate, in °/h, each the mean over the time from one to the next."""
    return noise.angle_random_walk_deg_sqrt_h * math.sqrt(3600.0 * rate_hz)
