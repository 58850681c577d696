"""What exciters do to a table: acceleration along its axes x, y, z as a function of time."""

from functools import lru_cache
from typing import Final

import numpy as np

from tumble.drivers.excitation import STANDARD_GRAVITY_M_S2, Excitation, Random, Rotation, Sines, Tone
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.noise import generator
from tumble.drivers.simulated.two_axes.geometry import RAD_PER_ARCSEC
from tumble.drivers.simulated.vibration.settings import Distortion, SimulatedVibration

LINES: Final = 384
"""Sines of which random vibration is made, each at a place of its own in its part of the band."""
_RANDOM_STREAM: Final = 101
_TABLE_AXES: Final = "xyz"


class Motion:
    """Acceleration of the table, shape (rows, 3), in g; seconds since the world began.

    The element of the unit feels a frequency more than the references do where it has a resonance.
    """

    def __init__(self, settings: SimulatedVibration) -> None:
        self._settings = settings
        resonance = settings.effects.frequency_response
        self._natural_hz = resonance.natural_hz if resonance else np.inf

    def table_g(self, excitation: Excitation, time_s: FloatArray, *, felt: bool = False) -> FloatArray:
        """What the table does, or what the element of the unit feels of it."""
        table_g = np.zeros((len(time_s), 3))
        match excitation:
            case Sines(tones=tones):
                for tone in tones:
                    table_g[:, _TABLE_AXES.index(tone.shaker or "x")] += self._tone_g(tone, time_s, felt)
            case Random():
                table_g[:, 0] = self._random_g(excitation, time_s, felt)
            case Rotation():
                table_g[:, :2] = self._turning_g(excitation, time_s, felt)
        if not isinstance(excitation, Rotation):
            table_g *= 1.0 + self._settings.level_error
            table_g[:, 1] += self._settings.effects.shaker_cross.ratio * table_g[:, 0]
        return table_g

    def tilt_g(self, excitation: Excitation, time_s: FloatArray) -> FloatArray:
        """Gravity that comes and goes along x and y of the table of a leaning centrifuge, shape (rows, 3)."""
        tilted_g = np.zeros((len(time_s), 3))
        if isinstance(excitation, Rotation):
            angle_rad = (excitation.main_rad_s + excitation.sub_rad_s) * time_s
            lean_rad = RAD_PER_ARCSEC * self._settings.tilt_arcsec
            tilted_g[:, 0], tilted_g[:, 1] = lean_rad * np.cos(angle_rad), -lean_rad * np.sin(angle_rad)
        return tilted_g

    def _felt(self, frequency_hz: FloatArray | float) -> FloatArray | float:
        return 1.0 / (1.0 - (frequency_hz / self._natural_hz) ** 2)

    def _tone_g(self, tone: Tone, time_s: FloatArray, felt: bool) -> FloatArray:
        actual_hz = tone.frequency_hz * (1.0 + self._settings.frequency_error)
        phase_rad = 2.0 * np.pi * actual_hz * time_s + np.deg2rad(tone.phase_deg or 0.0)
        shape = sum(
            gain * (self._felt(order * actual_hz) if felt else 1.0) * np.sin(order * phase_rad + shift_rad)
            for order, gain, shift_rad in _harmonics(self._settings.distortion)
        )
        return np.asarray(tone.level_g * shape)

    def _random_g(self, excitation: Random, time_s: FloatArray, felt: bool) -> FloatArray:
        hz, width_hz, phase_rad = _lines(excitation.frequencies_hz, self._settings.seed)
        density = np.exp(np.interp(np.log(hz), np.log(excitation.frequencies_hz), np.log(excitation.density_g2_hz)))
        peak_g = np.sqrt(2.0 * density * width_hz) * (self._felt(hz) if felt else 1.0)
        return np.asarray(np.sin(2.0 * np.pi * np.outer(time_s, hz) + phase_rad) @ peak_g)

    def _turning_g(self, excitation: Rotation, time_s: FloatArray, felt: bool) -> FloatArray:
        level_g = self._settings.arm_m * excitation.main_rad_s**2 / STANDARD_GRAVITY_M_S2
        if felt:
            level_g *= float(self._felt(abs(excitation.sub_rad_s) / (2.0 * np.pi)))
        angle_rad = excitation.sub_rad_s * time_s
        return level_g * np.stack([np.cos(angle_rad), -np.sin(angle_rad)], axis=1)


def _harmonics(distortion: Distortion) -> list[tuple[int, float, float]]:
    """Order, gain and phase of what a shaker makes of a sine."""
    harmonics = [
        (1, 1.0, 0.0),
        (2, distortion.second, np.deg2rad(distortion.second_phase_deg)),
        (3, distortion.third, np.deg2rad(distortion.third_phase_deg)),
    ]
    return [each for each in harmonics if each[1]]


@lru_cache(maxsize=16)
def _lines(points_hz: tuple[float, ...], seed: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Frequency, width and phase of each sine of random vibration."""
    random = generator(seed, _RANDOM_STREAM)
    edges_hz = np.linspace(points_hz[0], points_hz[-1], LINES + 1)
    widths_hz = np.diff(edges_hz)
    return edges_hz[:-1] + widths_hz * random.random(LINES), widths_hz, random.uniform(0.0, 2.0 * np.pi, LINES)
