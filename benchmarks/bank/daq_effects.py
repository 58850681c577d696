"""Effects of the instrument: errors of the reading, from the voltages at its input."""

from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import Effect, ReadingEffect, Run
from benchmarks.bank.unit_effects import either_sign


def _drawn_settling(rng: np.random.Generator, _: Run) -> Effect:
    """What remains is a part of the previous reading, itself unsettled, or a part of the previous voltage."""
    recursive = rng.uniform() < 0.5
    shape, error_v = (
        ("previous reading", _remains_of_reading) if recursive else ("previous voltage", _remains_of_voltage)
    )
    return ReadingEffect(name="settling", shape=shape, error_v=error_v)


def _remains_of_voltage(run: Run, voltage_v: FloatArray, fraction: float) -> FloatArray:
    before = np.concatenate([voltage_v[:1], voltage_v[:-1]])
    return np.asarray(fraction * np.where(run.dwells.follows, before - voltage_v, 0.0))


def _remains_of_reading(run: Run, voltage_v: FloatArray, fraction: float) -> FloatArray:
    reading_v, readings = 0.0, []
    for voltage, kept in zip(voltage_v.tolist(), (fraction * run.dwells.follows).tolist(), strict=True):
        reading_v = voltage + kept * (reading_v - voltage)
        readings.append(reading_v)
    return np.array(readings) - voltage_v


def _drawn_nonlinearity(rng: np.random.Generator, _: Run) -> Effect:
    """A wave over the voltage: from 0 V on, of any phase, or leaning to one side."""
    period_v = float(rng.uniform(0.25, 1.3))
    shape = ("phase 0", "any phase", "leaning")[rng.integers(3)]
    phase_rad = 0.0 if shape == "phase 0" else float(rng.uniform(0.0, 2.0 * np.pi))
    lean = 0.3 if shape == "leaning" else 0.0

    def error_v(_: Run, voltage_v: FloatArray, amplitude: float) -> FloatArray:
        turn = 2.0 * np.pi * voltage_v / period_v + phase_rad
        return np.asarray(amplitude * np.sin(turn + lean * np.sin(turn)))

    return ReadingEffect(
        name="daq_nonlinearity",
        shape=shape,
        amplitude_key="amplitude",
        others={"period_V": period_v},
        error_v=error_v,
    )


def _drawn_range_step(rng: np.random.Generator, _: Run) -> Effect:
    threshold_v, width_v = float(2.5 + rng.uniform(-0.85, 0.85)), float(rng.uniform(0.002, 0.02))
    return range_step(("sharp", "rounded", "hysteresis")[rng.integers(3)], threshold_v, width_v, either_sign(rng))


def range_step(shape: str, threshold_v: float, width_v: float, sign: float) -> Effect:
    """Make a range step: sharp, rounded over a few millivolts, or with the small hysteresis of an autoranging meter."""

    def error_v(_: Run, voltage_v: FloatArray, amplitude: float) -> FloatArray:
        above_v = voltage_v - threshold_v
        if shape == "sharp":
            return np.asarray(amplitude * (above_v > 0.0))
        if shape == "rounded":
            return np.asarray(0.5 * amplitude * (1.0 + np.tanh(above_v / width_v)))
        return np.asarray(amplitude * _upper_range(above_v, width_v))

    return ReadingEffect(
        name="range_step",
        shape=shape,
        sign=sign,
        amplitude_key="step",
        others={"threshold_V": threshold_v},
        error_v=error_v,
    )


def _upper_range(above_v: FloatArray, width_v: float) -> NDArray[np.bool_]:
    """Range of a meter that goes up at +`width_v` and down at -`width_v`, and holds in between."""
    outside = np.abs(above_v) > width_v
    outside[0] = True
    last = np.maximum.accumulate(np.where(outside, np.arange(len(above_v)), 0))
    return np.asarray(above_v[last] > 0.0)


DAQ_EFFECTS: Final = MappingProxyType(
    {
        "settling": _drawn_settling,
        "daq_nonlinearity": _drawn_nonlinearity,
        "range_step": _drawn_range_step,
    }
)
"""How to draw each effect that belongs to the instrument."""
