"""Noise of one dwell mean, in volts."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

import numpy as np

from benchmarks.bank.geometry import FloatArray

Draw = Callable[[FloatArray, float, np.random.Generator], FloatArray]

FLICKER_FLOOR_V = 20e-6
"""Floor of the Allan deviation of the flicker noise."""


def _white(time_s: FloatArray, level_v: float, rng: np.random.Generator) -> FloatArray:
    return rng.normal(0.0, level_v, len(time_s))


def _student(time_s: FloatArray, level_v: float, rng: np.random.Generator) -> FloatArray:
    """Student's t with 4 degrees of freedom, scaled to the standard deviation `level_v`."""
    return np.asarray(level_v / np.sqrt(2.0) * rng.standard_t(4, len(time_s)))


def _contaminated(time_s: FloatArray, level_v: float, rng: np.random.Generator) -> FloatArray:
    """Normal, but for 2 % of the rows five times as wide."""
    width = np.where(rng.uniform(size=len(time_s)) < 0.02, 5.0 * level_v, level_v)
    return width * rng.normal(size=len(time_s))


def _flicker(time_s: FloatArray, level_v: float, rng: np.random.Generator) -> FloatArray:
    """White noise and 1/f noise; S(f) = h/f has the Allan deviation sqrt(2 ln 2 h) (IEEE 1139)."""
    step_s = 2.0
    elapsed_s = time_s - time_s[0]
    count = 2 * (int(elapsed_s[-1] / step_s) + 2)  # twice the run: the sum of waves repeats itself
    frequency = np.fft.rfftfreq(count, step_s)[1:]
    density = FLICKER_FLOOR_V**2 / (2.0 * np.log(2.0)) / frequency
    wave = rng.normal(size=(2, len(frequency))) * np.sqrt(density * frequency[0])
    spectrum = np.concatenate([[0.0], 0.5 * (wave[0] + 1j * wave[1])])
    slow = np.fft.irfft(spectrum, count) * count
    return np.asarray(rng.normal(0.0, level_v, len(time_s)) + np.interp(elapsed_s, np.arange(count) * step_s, slow))


KINDS: Final[Mapping[str, Draw]] = MappingProxyType(
    {"white": _white, "student": _student, "contaminated": _contaminated, "flicker": _flicker}
)


def drawn_noise(kind: str, time_s: FloatArray, level_v: float, rng: np.random.Generator) -> FloatArray:
    """Draw the noise of every row.

    `level_v` is the standard deviation of the white part (of the core where the noise is contaminated).
    """
    if kind not in KINDS:
        raise ValueError(f"There is no noise {kind}; known are {', '.join(KINDS)}.")
    draw = KINDS[kind]
    return draw(time_s, level_v, rng)
