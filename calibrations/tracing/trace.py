"""Traces what the declared model leaves to named effects, to noise that remembers, or to structure without a name."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from calibrations.effects.effect import Effect, Form
from calibrations.effects.unnamed import STRUCTURES, Structure
from calibrations.tracing.candidates import all_columns, candidates
from calibrations.tracing.ground import Ground
from calibrations.tracing.noise import NoiseModel
from calibrations.tracing.problem import Problem
from calibrations.tracing.search import search

FLICKER_FLOOR = 0.25
"""Floor of the Allan deviation up to which flicker is taken as the ordinary noise of a unit, in dwell deviations."""
MOST_FLICKER = FLICKER_FLOOR**2 / (2 * np.log(2))
"""The same as variance of the first mode (IEEE Std 952, annex C: floor² = 2 ln 2 h)."""
FLICKER_PRICE = 3.84
WALK_PRICE = 10.0
"""What a random walk must earn: in flicker it is the cheaper explanation by that much once in hundreds of tables."""


@dataclass(frozen=True, kw_only=True)
class Found:
    """An effect in a form."""

    effect: Effect
    form: Form
    number: int
    """Of the candidate whose form this is, or from whose form it was refined."""
    entry: float

    @property
    def coefficients(self) -> int:
        """How many numbers are fitted: columns, and what was scanned for."""
        return int(self.form.columns.shape[1]) + len(self.form.scanned)


@dataclass(frozen=True, kw_only=True)
class Trace:
    """What a residual was traced to."""

    found: tuple[Found, ...]
    noise: NoiseModel
    deviance: float

    @property
    def named(self) -> tuple[Found, ...]:
        """Effects of the catalogue."""
        return tuple(found for found in self.found if not isinstance(found.effect, Structure))

    @property
    def unnamed(self) -> tuple[Found, ...]:
        """Structure that no effect of the catalogue explains."""
        return tuple(found for found in self.found if isinstance(found.effect, Structure))


class Tracer:
    """A table with everything that it may be traced to.

    Parameters
    ----------
    ground
        The table, fitted with the declared model.
    effects
        The catalogue.
    """

    def __init__(self, ground: Ground, effects: Sequence[Effect]) -> None:
        self.ground = ground
        self.effects = tuple(effects)
        self._offered = candidates((*effects, *STRUCTURES), ground.scene)
        self._columns = all_columns(self._offered, ground.rows)
        self._problems: dict[NoiseModel, Problem] = {}

    def problem(self, noise: NoiseModel) -> Problem:
        """The table in a kind of noise."""
        if noise not in self._problems:
            joint = self.ground.joint
            self._problems[noise] = Problem(
                self.ground.declared,
                self._columns,
                joint.observations.output_v,
                joint.weights,
                self._offered,
                self.ground.whitening(noise),
                joint.fit.alpha0_fitted,
            )
        return self._problems[noise]

    def trace(self) -> Trace:
        """Find the effects of the table.

        The search is made in white noise first. Where what it finds, or what it leaves, could as well be noise that
        remembers, it is made again in such noise, and the cheaper explanation is taken.
        """
        best = self._searched(NoiseModel())
        for noise in _other_noises(self.ground, best):
            trial = self._searched(noise)
            if _price(trial) < _price(best):
                best = trial
        return refined(self.ground, best)

    def _searched(self, noise: NoiseModel) -> Trace:
        problem = self.problem(noise)
        explanation = search(problem)
        chosen = tuple(found(problem, number) for number in explanation.chosen)
        return Trace(found=chosen, noise=noise, deviance=explanation.deviance)


def found(problem: Problem, number: int) -> Found:
    """A candidate of a problem, as found."""
    candidate = problem.offered[number]
    return Found(effect=candidate.effect, form=candidate.form, number=number, entry=candidate.entry)


def _price(trace: Trace) -> float:
    flicker = FLICKER_PRICE if trace.noise.flicker else 0.0
    walk = WALK_PRICE if trace.noise.walk else 0.0
    return trace.deviance + flicker + walk + sum(found.entry for found in trace.found)


def _other_noises(ground: Ground, white: Trace) -> list[NoiseModel]:
    """Noises worth a search of their own: the best flicker and walk, with nothing else and with what was found."""
    if ground.modes is None:
        return []
    noises = []
    for forms in ((), tuple(found.form for found in white.found)):
        level = ground.deviance(forms, NoiseModel())
        flicker = _best_noise(ground, forms, _FLICKERS)
        walk = _best_noise(ground, forms, _WALKS)
        noises += [noise for noise, deviance in (flicker, walk) if level - deviance > FLICKER_PRICE]
        if not white.found:
            break
    return list(dict.fromkeys(noises))


_FLICKERS = tuple(NoiseModel(flicker=float(part * MOST_FLICKER)) for part in (0.05, 0.15, 0.35, 0.65, 1.0))
_WALKS = tuple(NoiseModel(walk=float(walk)) for walk in np.geomspace(1e-3, 30.0, 10))


def _best_noise(ground: Ground, forms: Sequence[Form], tried: Sequence[NoiseModel]) -> tuple[NoiseModel, float]:
    deviances = [ground.deviance(forms, noise) for noise in tried]
    first = int(np.argmin(deviances))
    return tried[first], deviances[first]


def refined(ground: Ground, trace: Trace, rounds: int = 2) -> Trace:
    """Move what was scanned on a grid to where it fits best."""
    found = list(trace.found)
    for _ in range(rounds if any(item.effect.at for item in found) else 0):
        for place, item in enumerate(found):
            others = [other.form for other in (*found[:place], *found[place + 1 :])]
            found[place] = refined_one(ground, item, others, trace.noise)
    deviance = ground.deviance([item.form for item in found], trace.noise)
    return Trace(found=tuple(found), noise=trace.noise, deviance=deviance)


_GOLDEN = (np.sqrt(5.0) - 1) / 2
_RATIO = 1.35
"""Grids of scanned values are finer than this ratio between neighbours."""


def refined_one(ground: Ground, item: Found, others: Sequence[Form], noise: NoiseModel) -> Found:
    """The form of one effect with its scanned value by golden-section search about its grid value."""
    at = item.effect.at
    if at is None:
        return item
    (value,) = item.form.scanned.values()

    def deviance(trial: float) -> float:
        return ground.deviance([*others, at(ground.scene, trial)], noise)

    low, high = sorted((value / _RATIO, value * _RATIO))
    for _ in range(14):
        inner, outer = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        low, high = (low, outer) if deviance(inner) < deviance(outer) else (inner, high)
    better = (low + high) / 2
    if deviance(better) >= deviance(value):
        return item
    return replace(item, form=at(ground.scene, better))
