"""Traces what the declared model leaves to named effects, to autocorrelated noise, or to structure without a name."""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Any, Generic, Self, TypeVar

from tumble.calibrations.tracing.candidates import Candidate, all_columns, candidates
from tumble.calibrations.tracing.components import MARK, Component
from tumble.calibrations.tracing.effect import Effect, Form, Structure
from tumble.calibrations.tracing.fitting_noise import (
    best_level,
    best_walk,
    fitting,
    golden_section,
    is_slow,
    noise_penalty,
)
from tumble.calibrations.tracing.noise import WALK, WHITE, NoiseModel
from tumble.calibrations.tracing.penalties import UNNAMED
from tumble.calibrations.tracing.problem import Explanation, Problem
from tumble.calibrations.tracing.search import begun_anew, penalties, search, settled
from tumble.calibrations.tracing.table import Table

_NOTICED = 3.84


@dataclass(frozen=True, kw_only=True)
class Found:
    """A candidate that explains something, its form refined."""

    candidate: Candidate
    form: Form
    number: int
    """Of the candidate."""

    @property
    def effect(self) -> Effect[Any]:
        """The effect of which this is a form."""
        return self.candidate.effect

    @property
    def coefficients(self) -> int:
        """How many numbers are fitted: columns, and what was scanned for."""
        return self.candidate.coefficients


@dataclass(frozen=True, kw_only=True)
class Trace:
    """What a residual was traced to."""

    found: tuple[Found, ...]
    noise: NoiseModel
    deviance: float
    components: tuple[Component, ...] = ()
    """Structure without a name, which is noise to the rest, the largest first."""

    @property
    def named(self) -> tuple[Found, ...]:
        """Effects of the catalogue."""
        return tuple(found for found in self.found if not isinstance(found.effect, Structure))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all effects of the catalogue that were found, those that are autocorrelated noise included."""
        random = [name for name, _ in self.noise.levels if not name.startswith(MARK)]
        walk = [WALK] if self.noise.walk else []
        return tuple(dict.fromkeys([*(found.effect.name for found in self.named), *random, *walk]))

    @property
    def forms(self) -> list[Form]:
        """Forms of everything that is in the model as columns."""
        return [found.form for found in self.found]

    def without(self, name: str) -> "Trace":
        """The trace without one effect; its deviance is that of the whole still."""
        noise = replace(self.noise, walk=0.0) if name == WALK else self.noise.without(name)
        return replace(
            self,
            found=tuple(item for item in self.found if item.effect.name != name),
            noise=noise,
            components=tuple(each for each in self.components if each.name != name),
        )

    def without_form(self, form: "Found") -> "Trace":
        """The trace without one form of an effect; its deviance is that of the whole still."""
        return replace(self, found=tuple(item for item in self.found if item is not form))

    @property
    def unnamed(self) -> tuple[Found, ...]:
        """Structure that no effect of the catalogue explains."""
        return tuple(found for found in self.found if isinstance(found.effect, Structure))


def nothing_found(table: Table) -> Trace:
    """The declared model alone, in white noise."""
    return Trace(found=(), noise=NoiseModel(), deviance=table.deviance((), NoiseModel()))


_T = TypeVar("_T", bound=Table)


class Tracer(Generic[_T]):
    """A table with everything that it may be traced to.

    Parameters
    ----------
    table
        The table, ready to be fitted with the declared model.
    barred
        Effects that are not looked for.
    noise
        In which the search is made first.
    """

    def __init__(self, table: _T, barred: frozenset[str] = frozenset(), noise: NoiseModel = WHITE) -> None:
        self.table = table
        self.barred = barred
        self.noise = noise
        self.effects = table.effects
        self.offered = candidates(table)
        self.columns = all_columns(self.offered, table.rows)
        self._turned = table.whole.turned(self.columns)
        self._problems: dict[NoiseModel, Problem] = {}
        self.components: tuple[Component, ...] = ()

    def without(self, barred: frozenset[str]) -> Self:
        """The same table with other effects that are not looked for."""
        other = copy(self)
        other.barred = barred
        return other

    def among(self, table: _T, noise: NoiseModel) -> Self:
        """The same rows and effects where more can be noise, searched in a noise first."""
        other = copy(self)
        other.table, other.noise = table, noise
        other._turned, other._problems = table.whole.turned(self.columns), {}
        return other

    def beside(self, components: Sequence[Component]) -> Self:
        """The same where components may be noise."""
        if not components:
            return self
        other = self.among(self.table.with_seen(components), self.noise)
        other.components = tuple(components)
        return other

    def problem(self, noise: NoiseModel) -> Problem:
        """The table in a kind of noise."""
        if noise not in self._problems:
            whitened_fit, most = self.table.whole.whitened_fit(noise), self.table.most_effects
            self._problems[noise] = Problem(whitened_fit, self._turned, self.offered, most)
        return self._problems[noise].without(self.barred)

    def trace(self) -> Trace:
        """Find the effects of the table, as if there were no others.

        The search is made in white noise first. Where what it finds, or what it leaves, could as well be autocorrelated
        noise, it is made again in such noise, and the cheaper explanation is taken.
        """
        if self.table.not_traced:
            return nothing_found(self.table)
        white = self._searched(self.noise)
        others = [self._adapted(self._settled(noise, white)) for noise in self._other_noises(white)]
        best = min((self._with_random_effects(trace) for trace in (white, *others)), key=penalised_deviance)
        if best.noise.walk:
            best = min(best, self._without(best, WALK), key=penalised_deviance)
        return worth_their_penalty(self.table, self._with_single_forms(refined(self.table, best)))

    def _with_single_forms(self, trace: Trace) -> Trace:
        """Leave out the second form of an effect that stood only for a scanned value between two of the grid."""
        names = [item.effect.name for item in trace.found]
        double = [item for item in trace.found if names.count(item.effect.name) > 1]
        rests = [replace(trace, found=tuple(kept for kept in trace.found if kept is not item)) for item in double]
        return min((trace, *(refined(self.table, rest) for rest in rests)), key=penalised_deviance)

    def _other_noises(self, white: Trace) -> list[NoiseModel]:
        """Noises worth a search of their own: with what was found, or with the fast part of it.

        What changes slowly may be the wandering itself, taken for effects: without it both are always tried.
        """
        if not self.table.memory.modes.shape[1]:
            return []
        beside = fitting(self.table, white.forms, self.noise)
        noises = [noise for noise, deviance in beside if white.deviance - deviance > _NOTICED]
        slow = [item.effect.random or is_slow(self.table, item.form) for item in white.found]
        if any(slow):
            fast = [item.form for item, away in zip(white.found, slow, strict=True) if not away]
            noises += [noise for noise, _ in fitting(self.table, fast, self.noise)]
        return list(dict.fromkeys(noises))

    def _with_random_effects(self, trace: Trace) -> Trace:
        """A trace with random effects in its noise; settled again where there are any."""
        random = self._with_random_levels(trace)
        if random.noise.levels == trace.noise.levels:
            return trace
        again = self._with_random_levels(self._settled(random.noise, random))
        best = min(random, again, key=penalised_deviance)
        names = [name for name, _ in best.noise.levels if not name.startswith(MARK)]
        return min((best, *(self._without(best, name) for name in names)), key=penalised_deviance)

    def _without(self, trace: Trace, name: str) -> Trace:
        """A trace without an effect that is noise."""
        rest = trace.without(name)
        return replace(rest, deviance=self.table.deviance(rest.forms, rest.noise))

    def _with_random_levels(self, trace: Trace) -> Trace:
        """Take effects that draw levels out of the columns: of levels, only the variance is a parameter."""
        names = list(dict.fromkeys(item.effect.name for item in trace.found if item.effect.random))
        kept = tuple(item for item in trace.found if not item.effect.random)
        noise = trace.noise
        for name in names:
            noise = best_level(self.table, [item.form for item in kept], noise, name)
        deviance = self.table.deviance([item.form for item in kept], noise)
        return replace(trace, found=kept, noise=noise, deviance=deviance)

    def _adapted(self, trace: Trace) -> Trace:
        """A trace with the walk that suits what was found; searched again where that is another one."""
        if not trace.noise.walk:
            return trace
        noise, _ = best_walk(self.table, trace.forms, trace.noise)
        return trace if noise == trace.noise else min(trace, self._settled(noise, trace), key=penalised_deviance)

    def _searched(self, noise: NoiseModel) -> Trace:
        """Search; where structure without a name came out of it, again without: it may stand in for several effects."""
        problem = self.problem(noise)
        trace = self._traced(noise, begun_anew(problem, search(problem)))
        if not trace.unnamed:
            return trace
        return min(trace, self._traced(noise, search(problem.named())), key=penalised_deviance)

    def settled(self, noise: NoiseModel, start: Trace) -> Trace:
        """What another trace turns into in another noise, its random effects drawn."""
        return self._with_random_effects(self._settled(noise, start))

    def searched(self, noise: NoiseModel) -> Trace:
        """The best trace in a noise, its random effects drawn."""
        return self._with_random_effects(self._searched(noise))

    def _settled(self, noise: NoiseModel, start: Trace) -> Trace:
        """What another trace turns into in another noise."""
        problem = self.problem(noise)
        chosen = tuple(item.number for item in start.found if not (noise.levels and item.effect.random))
        return self._traced(noise, settled(problem, problem.explain(chosen)))

    def _traced(self, noise: NoiseModel, explanation: Explanation) -> Trace:
        problem = self.problem(noise)
        chosen = tuple(found(problem, number) for number in explanation.chosen)
        drawn = dict(noise.levels)
        components = tuple(each for each in self.components if each.name in drawn)
        return Trace(found=chosen, noise=noise, deviance=explanation.deviance, components=components)


def found(problem: Problem, number: int) -> Found:
    """A candidate of a problem, as found."""
    candidate = problem.offered[number]
    return Found(candidate=candidate, form=candidate.form, number=number)


def penalised_deviance(trace: Trace) -> float:
    """Deviance plus the penalties of everything in the trace."""
    named = noise_penalty(trace.noise) + penalties([found.candidate for found in trace.found])
    return trace.deviance + named + sum(UNNAMED + each.penalty for each in trace.components)


def worth_their_penalty(table: Table, trace: Trace) -> Trace:
    """A trace without named effects that explain too little once something else is there, or gone."""
    rests = [trace.without(name) for name in trace.names]
    fitted = [replace(rest, deviance=table.deviance(rest.forms, rest.noise)) for rest in rests]
    best = min((trace, *fitted), key=penalised_deviance)
    return trace if best is trace else worth_their_penalty(table, best)


def refined(table: Table, trace: Trace, rounds: int = 2) -> Trace:
    """Move what was scanned on a grid to where it fits best."""
    found = list(trace.found)
    for _ in range(rounds if any(item.effect.at for item in found) else 0):
        for place, item in enumerate(found):
            others = [other.form for other in (*found[:place], *found[place + 1 :])]
            found[place] = refined_one(table, item, others, trace.noise)
    deviance = table.deviance([item.form for item in found], trace.noise)
    return replace(trace, found=tuple(found), deviance=deviance)


_RATIO = 1.35
"""Grids of scanned values are finer than this ratio between neighbours."""


def refined_one(table: Table, item: Found, others: Sequence[Form], noise: NoiseModel) -> Found:
    """The form of one effect with its scanned value by golden-section search about its grid value."""
    at = item.effect.at
    if at is None:
        return item
    (value,) = item.form.scanned.values()

    beside = table.deviance_beside(others, noise)

    def deviance(trial: float) -> float:
        return beside(at(table.scene, trial))

    low, high = sorted((value / _RATIO, value * _RATIO))
    better = golden_section(deviance, low, high, steps=14)
    if deviance(better) >= deviance(value):
        return item
    return replace(item, form=at(table.scene, better))
