"""What a real table suffers from, and what is no effect: noise, gross disturbance, rounding, columns that lack."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from benchmarks.blind.clock import NOISE_V, SAMPLES
from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run

PLAIN: Final = "plain"
DESIGNED: Final[Mapping[str, str]] = {
    "irregular_angles": "irregular",
    "partial_sweeps": "partial",
    "flips_only": "flips",
}
"""Nuisances that are a design of their own."""

NUISANCES: Final = ("unequal_noise", "two_realisations", *DESIGNED, "bursts", "rounding", "missing_columns")
MILD: Final = ("unequal_noise", "two_realisations", "irregular_angles", "bursts", "rounding", "missing_columns")
"""Those under which an effect of the asked size can still be seen for what it is."""

_SPARE: Final = (("voltage_sd_V", "samples"), ("procedure",), ("temperature_degC",), ("direction", "procedure"))
_SHAKEN: Final = 0.15
"""Part of the tables in which vibration varies although the bias does not follow it."""


def with_noise(run: Run, nuisance: str, shaken: bool, rng: np.random.Generator) -> Run:
    """Return the run with the noise of each row, and what the samples within the dwell show of it and of vibration."""
    noise_v = NOISE_V * _level(run, nuisance, rng)
    shaking_v = 6e-4 * _machine(len(noise_v), rng) * (shaken or rng.random() < _SHAKEN)
    sampled = np.sqrt(rng.chisquare(SAMPLES - 1, len(noise_v)) / (SAMPLES - 1))
    return replace(run, noise_v=noise_v, voltage_sd_v=np.hypot(noise_v * np.sqrt(SAMPLES), shaking_v) * sampled)


def _level(run: Run, nuisance: str, rng: np.random.Generator) -> FloatArray:
    """Noise of each row as a multiple."""
    level = np.ones(len(run.time_s))
    if nuisance == "unequal_noise":
        by = (run.realisation, np.unique(run.mount, return_inverse=True)[1], np.arange(len(level)))[rng.integers(3)]
        return rng.uniform(0.6, 3.0, int(by.max()) + 1)[by]
    if nuisance == "bursts":
        for start in rng.integers(0, int((~run.fresh).sum()) - 8, int(rng.integers(2, 5))):
            level[start : start + rng.integers(3, 7)] = rng.uniform(5.0, 10.0)
    return level


def _machine(rows: int, rng: np.random.Generator) -> FloatArray:
    """A machine next door: stretches of rows with more vibration than others."""
    return np.repeat(rng.gamma(2.0, 0.5, rows // 12 + 1), 12)[:rows]


def quantum_v(nuisance: str, rng: np.random.Generator) -> float:
    """Return the resolution of the readings; 0 for full."""
    return float(rng.choice([0.5e-4, 1e-4, 2e-4])) if nuisance == "rounding" else 0.0


def left_out(nuisance: str, needed: frozenset[str], rng: np.random.Generator) -> tuple[str, ...]:
    """Return the columns that the table does without, none of those that an effect needs to be seen."""
    spare = [columns for columns in _SPARE if not needed & set(columns)]
    return spare[rng.integers(len(spare))] if nuisance == "missing_columns" else ()


def realisations(nuisance: str) -> int:
    """Return how many realisations the table holds."""
    return 2 if nuisance == "two_realisations" else 5
