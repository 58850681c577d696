"""Randomness that can be repeated: each draw is keyed by what it belongs to, each wandering is a function of time."""

from collections.abc import Callable
from enum import IntEnum
from functools import lru_cache

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray


class Stream(IntEnum):
    """What random numbers are for; streams never share a number."""

    SAMPLES = 1
    VIBRATION = 2
    SEATING = 3
    TURN_ON = 4
    FLICKER = 5
    RANDOM_WALK = 6
    ROOM = 7
    THERMOMETER = 8


def generator(seed: int, stream: int, number: int = 0, part: int = 0) -> np.random.Generator:
    """Generator of the numbers that belong to one dwell or mounting, the `number`-th of its stream, or to a part of it.

    Philox is a counter-based generator: seed and stream are its key, number and part the highest words of its counter.
    """
    key = np.array([seed, stream], dtype=np.uint64)
    counter = np.array([0, 0, part, number], dtype=np.uint64)
    return np.random.Generator(np.random.Philox(key=key, counter=counter))


@lru_cache(maxsize=256)
def standard_normal(seed: int, stream: Stream, number: int, part: int = 0) -> float:
    """Draw the one normal number, of variance 1, that belongs to the `number`-th of a stream, or to a part of it."""
    return float(generator(seed, stream, number, part).standard_normal())


def interpolated(function: Callable[[FloatArray], FloatArray], times_s: FloatArray, step_s: float) -> FloatArray:
    """Interpolate a slow `function` of time between whole multiples of `step_s`, for speed; the times rise.

    The nodes do not depend on the times, so neither does the value at one of them depend on the others.
    """
    first, last = int(times_s[0] // step_s), int(times_s[-1] // step_s) + 1
    nodes_s: FloatArray = step_s * np.arange(first, last + 1, dtype=np.float64)
    return np.interp(times_s, nodes_s, function(nodes_s))


class Wander:
    """Stationary wandering with equal power in every octave of a band: a sum of sines, 12 in each decade.

    Frequencies and phases are drawn once; from then on the value is a function of time alone, whatever was asked
    before.
    """

    def __init__(self, random: np.random.Generator, *, rms: float, band_hz: tuple[float, float]) -> None:
        low_hz, high_hz = band_hz
        decades = np.log10(high_hz / low_hz)
        modes = int(np.ceil(12 * decades))
        exponents = (np.arange(modes) + random.random(modes)) / modes
        self._rad_per_s = 2.0 * np.pi * low_hz * 10.0 ** (decades * exponents)
        self._phase_rad = random.uniform(0.0, 2.0 * np.pi, modes)
        self._amplitude = rms * np.sqrt(2.0 / modes)
        self._step_s = 0.25 / high_hz

    def at(self, times_s: FloatArray) -> FloatArray:
        """Value at each of the times, which rise, in the unit of `rms`."""
        return interpolated(self._exactly_at, times_s, self._step_s) if self._amplitude else 0.0 * times_s

    def _exactly_at(self, times_s: FloatArray) -> FloatArray:
        angles_rad = times_s[:, np.newaxis] * self._rad_per_s + self._phase_rad
        return np.asarray(self._amplitude * np.sin(angles_rad).sum(axis=-1))


FLICKER_BAND_HZ = (1e-5, 1.0)


def flicker(seed: int, floor_v: float) -> Wander:
    """1/f noise whose Allan deviation is `floor_v` for averaging times from a few seconds to a few hours.

    A one-sided spectral density h / f has an Allan variance of 2 ln 2 h (IEEE 1139), and a variance of
    h ln(f2 / f1) in the band from f1 to f2.
    """
    low_hz, high_hz = FLICKER_BAND_HZ
    rms_v = floor_v * np.sqrt(np.log(high_hz / low_hz) / (2.0 * np.log(2.0)))
    return Wander(generator(seed, Stream.FLICKER), rms=float(rms_v), band_hz=FLICKER_BAND_HZ)


class RandomWalk:
    """Wandering without a fixed shape: independent increments each second, straight lines between."""

    CHUNK_S = 3600

    def __init__(self, seed: int, *, v_per_sqrt_h: float) -> None:
        self._seed = seed
        self._step_v = v_per_sqrt_h / np.sqrt(3600.0)
        self._value_v = np.zeros(1)

    def at(self, times_s: FloatArray) -> FloatArray:
        """Value at each of the times, which are not negative, in volts; zero at the beginning."""
        if self._step_v == 0.0:
            return 0.0 * times_s
        second = times_s.astype(np.int64)
        while len(self._value_v) < second.max() + 2:
            self._extend()
        left_v, right_v = self._value_v[second], self._value_v[second + 1]
        return np.asarray(left_v + (times_s - second) * (right_v - left_v))

    def _extend(self) -> None:
        random = generator(self._seed, Stream.RANDOM_WALK, len(self._value_v) // self.CHUNK_S)
        walked_v = np.cumsum(self._step_v * random.standard_normal(self.CHUNK_S))
        self._value_v = np.concatenate([self._value_v, self._value_v[-1] + walked_v])
