"""Which autocorrelated noise suits a table, for given effects, and its penalty."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from tumble.calibrations.tracing.components import MARK
from tumble.calibrations.tracing.effect import Form
from tumble.calibrations.tracing.noise import SETTINGS, NoiseModel
from tumble.calibrations.tracing.penalties import FLICKER, LEVEL, WALK
from tumble.calibrations.tracing.table import Table

FLICKER_FLOOR = 0.25
"""Floor of the Allan deviation up to which flicker is taken as the ordinary noise of a unit, in dwell deviations."""
MOST_FLICKER = FLICKER_FLOOR**2 / (2 * np.log(2))
"""The same as variance of the first mode (IEEE Std 952, annex C: floor² = 2 ln 2 h)."""


def noise_penalty(noise: NoiseModel) -> float:
    """What everything in a noise beyond white is penalised by in -2 ln L; components have penalties of their own."""
    flicker = FLICKER if noise.flicker else 0.0
    walk = WALK if noise.walk else 0.0
    drawn = [name for name, _ in noise.levels if name == SETTINGS or not name.startswith(MARK)]
    return flicker + walk + LEVEL * len(drawn)


def fitting(table: Table, forms: Sequence[Form], noise: NoiseModel) -> tuple[tuple[NoiseModel, float], ...]:
    """The flicker and the walk that fit best with these forms beside a noise, each with its deviance."""
    flickers = [replace(noise, flicker=tried.flicker) for tried in _FLICKERS]
    return _best(table.deviance_by_noise(forms), flickers), best_walk(table, forms, noise)


def with_likely_flicker(table: Table, forms: Sequence[Form], noise: NoiseModel) -> NoiseModel:
    """The noise with the flicker that is to be expected beside it: each level weighed by its likelihood.

    Flicker may be there below its penalty: it is the ordinary noise of a unit, and what it does to the mean of a
    run no residual shows.
    """
    if noise.flicker or noise.walk or not table.memory.modes.shape[1]:
        return noise
    deviance = table.deviance_by_noise(forms)
    levels = np.array([0.0, *(tried.flicker for tried in _FLICKERS)])
    deviances = np.array([deviance(replace(noise, flicker=float(level))) for level in levels])
    weights = np.exp(-0.5 * (deviances - deviances.min()))
    return replace(noise, flicker=float(weights @ levels / weights.sum()))


def is_slow(table: Table, form: Form) -> bool:
    """Whether a shape is nearly all made of waves of which the run holds few."""
    white = table.memory.whitening(NoiseModel(walk=100.0))
    columns = form.columns * np.sqrt(table.weights)[:, None]
    columns = columns - columns.mean(axis=0)
    return bool(np.sum(white(columns) ** 2) < _MOSTLY_SLOW * np.sum(columns**2))


_MOSTLY_SLOW = 0.2
_FLICKERS = tuple(NoiseModel(flicker=float(part * MOST_FLICKER)) for part in (0.05, 0.15, 0.35, 0.65, 1.0))
_WALKS = (0.003, 0.03, 0.3, 3.0, 30.0)


def _best(deviance: Callable[[NoiseModel], float], tried: Sequence[NoiseModel]) -> tuple[NoiseModel, float]:
    deviances = [deviance(noise) for noise in tried]
    first = int(np.argmin(deviances))
    return tried[first], deviances[first]


def best_walk(table: Table, forms: Sequence[Form], noise: NoiseModel) -> tuple[NoiseModel, float]:
    """The noise with the random walk that fits best in place of flicker, and its deviance."""
    deviance = table.deviance_by_noise(forms)
    walks = [replace(noise, flicker=0.0, walk=walk) for walk in _WALKS]
    coarse, _ = _best(deviance, walks)
    finer = [replace(coarse, walk=coarse.walk * ratio) for ratio in (1 / 3, 1.0, 3.0)]
    return _best(deviance, finer)


def best_level(table: Table, forms: Sequence[Form], noise: NoiseModel, name: str) -> NoiseModel:
    """The noise with an effect as a random one, with the variance that fits best."""
    deviance = table.deviance_by_noise(forms)

    def at(logarithm: float) -> NoiseModel:
        return noise.with_level(name, float(np.exp(logarithm)))

    low, high = float(np.log(1e-4)), float(np.log(1e4))
    return at(golden_section(lambda logarithm: deviance(at(logarithm)), low, high, steps=20))


_GOLDEN = (np.sqrt(5.0) - 1) / 2


def golden_section(function: Callable[[float], float], low: float, high: float, steps: int) -> float:
    """Where a function with one minimum has it (Kiefer 1953): every step asks for one value, the other is known."""
    inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_inner, at_outer = function(inner), function(outer)
    for _ in range(steps - 1):
        if at_inner < at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - _GOLDEN * (high - low)
            at_inner = function(inner)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + _GOLDEN * (high - low)
            at_outer = function(outer)
    low, high = (low, outer) if at_inner < at_outer else (inner, high)
    return float((low + high) / 2)
