"""Simulated dwells: the acceleration of every sample of a period, the cubic and quartic response of the unit, means.

No line is shared with the analysis. What nature does to the motion acts on the motion, what it does to the output on
that.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from benchmarks.vibration.designs import Array, Dwell, design

NOISE_UG = 3.0
SAMPLES = 4096
"""Of whole periods, in the mean."""
SPREAD = 0.12
"""Relative scatter of a stated uncertainty."""


@dataclass
class Run:
    """What effects may change; all of it is there before they act. Arrays of shape (dwells,) unless said."""

    dwells: list[Dwell]
    time_s: Array
    long_s: Array
    temperature_degc: Array
    rng: np.random.Generator
    coefficients: Array
    """K_ii … K_ip in µg/g²."""
    cubic: float = 0.0
    quartic: float = 0.0
    cross: float = 0.0
    """Sideways motion, in parts of the drive, in phase."""
    natural_hz: float = 0.0
    limit_g: float = 0.0
    partial: float = 0.0
    """Part of the error of a cut period that is left."""
    added_ug: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        """Nothing is added yet."""
        self.added_ug = np.zeros(len(self.dwells))

    @property
    def level_g(self) -> Array:
        """Of every dwell."""
        return np.array([each.level_g for each in self.dwells])

    @property
    def drive_g2(self) -> Array:
        """Mean square of the drive."""
        return np.array([each.level_g**2 * (1.0 if each.random else 0.5) for each in self.dwells])

    @property
    def along_input_g2(self) -> Array:
        """Mean square of the motion along the input axis, sine or random."""
        random = np.array([each.random * (each.level_g * each.drive[0]) ** 2 for each in self.dwells])
        return random + 0.5 * np.array([each.peak_g[0] ** 2 for each in self.dwells])

    @property
    def frequency_hz(self) -> Array:
        """The highest of the three."""
        return np.array([each.frequency_hz.max() for each in self.dwells])

    @property
    def shaken(self) -> Array:
        """1 on a shaker."""
        return np.array(["shaker" in each.apparatus for each in self.dwells], dtype=float)


Effect = Callable[[Run, float], None]
"""Changes a run by an effect of a size."""


@dataclass(frozen=True)
class Made:
    """A table, what was put in, and what effects add to its rows."""

    columns: Mapping[str, list[float] | list[str]]
    coefficients: Array
    effect_ug: Array
    noise_ug: Array


def make(seed: int, name: str, effects: Mapping[str, tuple[Effect, float]], noise_ug: float = NOISE_UG) -> Made:
    """Simulate a programme; each effect with its size."""
    with_effects, clean = (_run(seed, name, each) for each in (effects, {}))
    rng = np.random.default_rng([seed, 2])
    rests_ug = rng.normal(0.0, 300.0, 64)
    true_ug = outputs(with_effects)
    shown = rests_ug[[each.mounting for each in with_effects.dwells]] + true_ug
    noise = rng.normal(0.0, noise_ug, len(shown))
    stated = noise_ug * np.exp(rng.normal(0.0, SPREAD, len(shown)))
    return Made(
        columns=_columns(with_effects, shown + noise, stated),
        coefficients=clean.coefficients,
        effect_ug=true_ug - outputs(clean),
        noise_ug=np.full(len(shown), noise_ug),
    )


def _run(seed: int, name: str, effects: Mapping[str, tuple[Effect, float]]) -> Run:
    rng = np.random.default_rng([seed, 1])
    dwells = design(name, rng)
    count = len(dwells)
    long_s = 45.0 + rng.uniform(-0.5, 0.5, count)
    gaps_s = 12.0 + rng.uniform(0.0, 1.0, count)
    moved = np.diff([each.mounting for each in dwells], prepend=dwells[0].mounting) != 0
    again = np.diff([each.realisation for each in dwells], prepend=1) != 0
    starts_s = np.cumsum(gaps_s + 240.0 * moved + 180.0 * again) + np.concatenate([[0.0], np.cumsum(long_s)[:-1]])
    time_s = starts_s + long_s / 2.0
    warmth = 23.0 + 1.5 * np.cumsum(rng.normal(0.0, 0.08, count)) + rng.normal(0.0, 0.02, count)
    scale = np.array([25.0, 8.0, 8.0, 12.0, 12.0])
    run = Run(
        dwells=dwells, time_s=time_s, long_s=long_s, temperature_degc=warmth, rng=np.random.default_rng([seed, 3]),
        coefficients=rng.normal(0.0, 1.0, 5) * scale,
    )  # fmt: skip
    for effect, size in effects.values():
        effect(run, size)
    return run


def outputs(run: Run) -> Array:
    """Mean output of every dwell without its rest output and without noise, in µg."""
    return (
        np.array([_mean_ug(run, each, long_s) for each, long_s in zip(run.dwells, run.long_s, strict=True)])
        + run.added_ug
    )


def _mean_ug(run: Run, dwell: Dwell, long_s: float) -> float:
    """Of the nonlinear response to the acceleration of every sample, less what it is at rest."""
    moved = _motion(run, dwell)
    whole = dwell.gravity_g[:, None] + moved
    mean = float(np.mean(_response_ug(run, whole, moved[0], dwell))) - float(
        _response_ug(run, dwell.gravity_g[:, None], np.zeros(1), Dwell("", 1, 1, dwell.gravity_g))[0]
    )
    if run.limit_g:
        mean += 1e6 * float(np.mean(np.minimum(whole[0], run.limit_g) - whole[0]))
    if run.partial and dwell.frequency_hz[0] > 0:
        turned = 2.0 * np.pi * dwell.frequency_hz[0] * long_s
        phase = dwell.phase_rad[0]
        mean += run.partial * 1e6 * dwell.peak_g[0] * (np.cos(phase) - np.cos(phase + turned)) / turned
    return mean


def _motion(run: Run, dwell: Dwell) -> Array:
    """Acceleration of the samples, shape (3, samples)."""
    if dwell.random:
        sigma = dwell.level_g
        nodes, weights = np.polynomial.hermite_e.hermegauss(16)
        values = np.repeat(nodes, np.maximum(np.round(weights / weights.sum() * SAMPLES).astype(int), 0))
        values = values / np.std(values) * sigma
        way = dwell.drive + run.cross * dwell.lateral
        return np.outer(way, values)
    if not dwell.peak_g.any():
        return np.zeros((3, 1))
    frequency = dwell.frequency_hz[dwell.frequency_hz > 0]
    turns = (np.arange(SAMPLES) + 0.5) / SAMPLES
    periods = np.where(dwell.frequency_hz > 0, 1.0, 0.0)
    if len(np.unique(frequency)) > 1:
        periods = np.array([3.0, 7.0, 11.0]) * (dwell.frequency_hz > 0)
    waves = dwell.peak_g[:, None] * np.sin(2.0 * np.pi * periods[:, None] * turns + dwell.phase_rad[:, None])
    if run.cross and dwell.drive.any():
        along = dwell.drive @ waves
        waves = waves + run.cross * np.outer(dwell.lateral, along)
    return np.asarray(waves)


def _response_ug(run: Run, whole: Array, moved: Array, dwell: Dwell) -> Array:
    i, o, p = whole
    k_ii, k_oo, k_pp, k_io, k_ip = run.coefficients
    quadratic = k_ii * i**2 + k_oo * o**2 + k_pp * p**2 + k_io * i * o + k_ip * i * p
    if run.natural_hz and dwell.frequency_hz[0] > 0:
        ratio = dwell.frequency_hz[0] / run.natural_hz
        gain2 = 1.0 / ((1.0 - ratio**2) ** 2 + (0.04 * ratio) ** 2)
        quadratic = quadratic + k_ii * (gain2 - 1.0) * moved**2
    return np.asarray(quadratic + run.cubic * i**3 + run.quartic * i**4)


def _columns(run: Run, output_ug: Array, stated_ug: Array) -> dict[str, list[float] | list[str]]:
    dwells = run.dwells
    vectors = {
        "drive_{}": "drive",
        "lateral_{}": "lateral",
        "g{}_g": "gravity_g",
        "a{}_g": "peak_g",
        "f{}_Hz": "frequency_hz",
    }
    columns: dict[str, list[float] | list[str]] = {
        "time_s": run.time_s.tolist(),
        "realisation": [each.realisation for each in dwells],
        "apparatus": [each.apparatus for each in dwells],
        "mounting": [each.mounting for each in dwells],
    }
    for spelt, field_name in vectors.items():
        for place, axis in enumerate("iop"):
            columns[spelt.format(axis)] = [float(getattr(each, field_name)[place]) for each in dwells]
    for place, axis in enumerate("iop"):
        columns[f"phase_{axis}_deg"] = [round(float(np.rad2deg(each.phase_rad[place])), 3) for each in dwells]
    columns |= {
        "level_g": [each.level_g for each in dwells],
        "main_rad_s": [each.main_rad_s for each in dwells],
        "sub_rad_s": [each.sub_rad_s for each in dwells],
        "dwell_s": run.long_s.tolist(),
        "temperature_degC": np.round(run.temperature_degc, 3).tolist(),
        "output_ug": np.round(output_ug, 3).tolist(),
        "output_u_ug": np.round(stated_ug, 3).tolist(),
    }
    if any(each.random for each in dwells):
        products = {"mii_g2": (0, 0), "moo_g2": (1, 1), "mpp_g2": (2, 2), "mio_g2": (0, 1), "mip_g2": (0, 2)}
        for name, (first, second) in products.items():
            columns[name] = [
                each.level_g**2 * float(each.drive[first] * each.drive[second]) if each.random else float("nan")
                for each in dwells
            ]
    return columns
