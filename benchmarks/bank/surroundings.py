"""Temperature and vibration around a run, whether or not the unit minds them."""

import numpy as np

from benchmarks.bank.dwells import Dwells
from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import SAMPLES, Run

REFERENCE_DEGC = 23.0
THERMOMETER_DEGC = 0.01
"""Standard deviation of one reading of the thermometer."""


def drawn_run(dwells: Dwells, design: str, noise_v: float, shaken: bool, rng: np.random.Generator) -> Run:
    """Surround a design: a ramp of temperature where its name holds `t`, vibration where it is `shaken`."""
    expected_sd_v = noise_v * np.sqrt(SAMPLES) * (_vibration(len(dwells), rng) if shaken else np.ones(len(dwells)))
    spread = np.sqrt(rng.chisquare(SAMPLES - 1, len(dwells)) / (SAMPLES - 1))
    temperature_degc = REFERENCE_DEGC + _wandering(dwells, rng)
    if "t" in design:
        temperature_degc += _ramp(dwells, rng)
    return Run(
        dwells=dwells,
        temperature_degc=temperature_degc,
        expected_sd_v=expected_sd_v,
        measured_sd_v=expected_sd_v * spread,
    )


def _wandering(dwells: Dwells, rng: np.random.Generator) -> FloatArray:
    """Air of a quiet room: two slow waves of about a tenth of a kelvin."""
    period_s = rng.uniform(2000.0, 9000.0, 2)
    phase_rad = rng.uniform(0.0, 2.0 * np.pi, 2)
    waves = np.sin(2.0 * np.pi * dwells.elapsed_s[:, None] / period_s + phase_rad)
    return np.asarray(waves @ rng.uniform(0.05, 0.15, 2))


def _ramp(dwells: Dwells, rng: np.random.Generator) -> FloatArray:
    """A climb or a fall of 3 K to 20 K over the run, with a wave on it so that it is no copy of time."""
    part = dwells.elapsed_s / dwells.elapsed_s[-1]
    climb_k = rng.choice([-1.0, 1.0]) * rng.uniform(3.0, 20.0)
    wave = rng.uniform(0.1, 0.3) * np.sin(2.0 * np.pi * (rng.uniform(0.8, 2.2) * part + rng.uniform()))
    return np.asarray(climb_k * (part + wave - wave[0]))


def _vibration(rows: int, rng: np.random.Generator) -> FloatArray:
    """Scatter of the samples, 1 where it is quiet: every dwell its own, or a machine that is switched on and off."""
    if rng.uniform() < 0.5:
        return np.asarray(np.exp(np.abs(rng.normal(0.0, 0.7, rows))))
    level = np.ones(rows)
    for start in rng.integers(0, rows, rng.integers(1, 5)):
        stop = start + rng.integers(rows // 20, rows // 5)
        level[start:stop] = rng.uniform(3.0, 10.0) * np.exp(rng.normal(0.0, 0.15, len(level[start:stop])))
    return level
