"""Explanations near the one that is stated, each with its odds: what is said of a parameter holds over all of them.

The search asks so much of an effect that a clean table is given one in a thousand times; that is no measure of how
likely an effect is to be there. Here effects count as if one in fifty tables held one (Bayesian model averaging;
Hoeting, Madigan, Raftery and Volinsky 1999), so that what was nearly found, or barely, is not taken for certain.

A bias that wanders is called a walk, and its mean over the rows is part of the bias. Any other course, a contact that
comes and goes, looks much like one and has its rest elsewhere: whether it is the one or the other, their likelihoods
alone decide.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any, Final

import numpy as np

from tumble.calibrations.tracing.beyond import WANDERING, in_place
from tumble.calibrations.tracing.candidates import Candidate
from tumble.calibrations.tracing.effect import Structure
from tumble.calibrations.tracing.family import Family
from tumble.calibrations.tracing.fitting_noise import best_level
from tumble.calibrations.tracing.gains import seen_beside
from tumble.calibrations.tracing.noise import WALK
from tumble.calibrations.tracing.pairs import WIDEST, best_pairs
from tumble.calibrations.tracing.penalties import FALSE_ALARM, NOT_FOUND
from tumble.calibrations.tracing.problem import Problem
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.search import runners_up
from tumble.calibrations.tracing.trace import Found, Trace, Tracer, found, penalised_deviance, refined

_ALLOWED: Final = 2.0 * float(np.log(NOT_FOUND / FALSE_ALARM))
"""By so much less an effect is penalised here than in the search."""
_LEAST: Final = 2e-3
"""Explanations with smaller odds are left out."""
_PAIRS: Final = 4
"""So many pairs of further effects are looked at."""
_SETS: Final = 8
"""So many of the cheapest sets that the search followed are looked at."""
_EXCHANGED: Final = 2
"""So many names differ where one effect is exchanged."""
_SPARE: Final = 4 * WIDEST
"""Of so few settings beyond what is fitted any pair would explain nearly all by which they differ."""
_DRAWN: Final = 1.0
"""Levels that gain less are next to nothing: their variance is at its bound."""


@dataclass(frozen=True, kw_only=True)
class Neighbour:
    """Another explanation."""

    trace: Trace
    odds: float
    """Against the one that is stated."""
    differs: str
    """The effect by which it differs."""


def every_near(
    tracer: Tracer[Any], trace: Trace, near: Mapping[str, Sequence[Rival]], others: Sequence[Trace]
) -> list[Neighbour]:
    """The `neighbours` of an explanation, and the same explanation in other shapes.

    It is one explanation, in whichever of its shapes: what is held against it has its odds against all of them.
    """
    alike = in_other_shapes(tracer, trace)
    together = 1.0 + sum(each.odds for each in alike)
    listed = neighbours(tracer, trace, near, others)
    return [*alike, *(replace(each, odds=together * each.odds) for each in listed)]


def neighbours(
    tracer: Tracer[Any], trace: Trace, near: Mapping[str, Sequence[Rival]], others: Sequence[Trace]
) -> list[Neighbour]:
    """Explanations with another effect in the place of one, with one more, with one less, or of another structure.

    `near` are the rivals of each effect, `others` traces with other structure, or with names in its place.
    """
    everything = tracer.without(frozenset())
    listed = [
        *((rival.name, rival.trace) for rivals in near.values() for rival in rivals),
        *_with_one_more(everything, trace),
        *_with_one_more_beside_another_form(everything, trace),
        *_with_two_more(everything, trace),
        *_of_other_effects(everything, trace),
        *_with_one_less(everything, trace),
        *_elsewhere(everything, others),
    ]
    return _likely([*_weighed(trace, listed), *_course_for_walk(everything, trace)])


def in_other_shapes(tracer: Tracer[Any], trace: Trace) -> list[Neighbour]:
    """The same explanation with its structure in every other shape that it could have.

    What is expected to wander is left out: such a course could be anything, and the random walk stands for it.
    """
    everything = tracer.without(frozenset())
    return _likely(_weighed(trace, _elsewhere(everything, _shaped_otherwise(everything, trace))))


def _weighed(trace: Trace, listed: Iterable[tuple[str, Trace]]) -> Iterator[Neighbour]:
    """Explanations by the name of what differs in each, with their odds against a trace."""
    least = _plausibility(trace)
    for name, each in listed:
        yield Neighbour(trace=each, odds=float(np.exp(0.5 * min(least - _plausibility(each), 0.0))), differs=name)


def _likely(weighed: Iterable[Neighbour]) -> list[Neighbour]:
    return [each for each in weighed if each.odds > _LEAST]


def _plausibility(trace: Trace) -> float:
    """Penalised deviance with penalties as of something that is expected now and then."""
    count = len(trace.names) + len(trace.components)
    return penalised_deviance(trace) - _ALLOWED * count


def _with_one_more(tracer: Tracer[Any], trace: Trace) -> Iterator[tuple[str, Trace]]:
    """The trace with each other effect of the catalogue that would gain nearly its penalty."""
    problem, table = tracer.problem(trace.noise), tracer.table
    worth = problem.gains(problem.explain(tuple(item.number for item in trace.found)))
    worth = worth - np.array([candidate.penalty for candidate in problem.offered]) + _ALLOWED
    for number in problem.best_forms(worth):
        effect = problem.offered[number].effect
        if effect.name in trace.names or isinstance(effect, Structure):
            continue
        if effect.random:
            noise = best_level(table, trace.forms, trace.noise, effect.name)
            drawn = replace(trace, noise=noise, deviance=table.deviance(trace.forms, noise))
            if drawn.deviance < trace.deviance - _DRAWN:
                yield effect.name, drawn
        elif worth[number] > 2.0 * np.log(_LEAST):
            further = (*trace.found, found(problem, number))
            deviance = table.deviance([item.form for item in further], trace.noise)
            yield effect.name, replace(trace, found=further, deviance=deviance)


def _with_one_more_beside_another_form(tracer: Tracer[Any], trace: Trace) -> Iterator[tuple[str, Trace]]:
    """The trace with each other effect along a variable beside another form of one that follows it.

    A slow warm-up may stand for a fast one and a drift: beside the slow one a drift gains nothing.
    """
    problem = tracer.problem(trace.noise)
    for item in trace.named:
        places = problem.forms[item.effect.name]
        rest = trace.without_form(item)
        others = tuple(each.number for each in rest.found)
        for number in _along(problem, others, item, trace.names) if places.stop - places.start > 1 else ():
            form = places.start + int(problem.gains(problem.explain((*others, number)))[places].argmax())
            both = replace(rest, found=(*rest.found, found(problem, number), found(problem, form)))
            behind = problem.explain((*others, number, form)).deviance - trace.deviance
            if form != item.number and behind + problem.penalties[number] - _ALLOWED < -2.0 * np.log(_LEAST):
                yield problem.offered[number].effect.name, refined(tracer.table, both, rounds=1)


def _with_two_more(tracer: Tracer[Any], trace: Trace) -> Iterator[tuple[str, Trace]]:
    """The trace with two other effects that together, if neither alone, would gain nearly their penalties."""
    problem = tracer.problem(trace.noise)
    explanation = problem.explain(tuple(item.number for item in trace.found))
    settings = len(np.unique(tracer.table.blocks("angle")))
    if len(trace.found) + 2 > problem.most or settings - len(explanation.fit.theta) < _SPARE:
        return
    numbers = [number for number, each in enumerate(problem.offered) if _may_join(each, trace.names)]
    for pair, worth in islice(best_pairs(problem, explanation, numbers), _PAIRS):
        if worth + 2.0 * _ALLOWED > 2.0 * np.log(_LEAST):
            both = replace(trace, found=(*trace.found, *(found(problem, number) for number in pair)))
            yield problem.offered[pair[0]].effect.name, refined(tracer.table, both, rounds=1)


def _of_other_effects(tracer: Tracer[Any], trace: Trace) -> Iterator[tuple[str, Trace]]:
    """Sets that the search followed and that differ by more than one effect added, left out or exchanged.

    Only in the noise in which the table was searched first: in another one all sets would be fitted for this alone.
    """
    if trace.noise != tracer.noise:
        return
    problem = tracer.problem(trace.noise).named()
    for explanation in islice(runners_up(problem), _SETS):
        items = [found(problem, number) for number in explanation.chosen]
        names = {item.effect.name for item in items}
        other, lacking = sorted(names.difference(trace.names)), set(trace.names) - names
        exchanged = other and lacking and len(other) + len(lacking) > _EXCHANGED
        if exchanged and not any(item.effect.random for item in items):
            yield other[0], refined(tracer.table, replace(trace, found=tuple(items)), rounds=1)


def _may_join(candidate: Candidate, taken: Sequence[str]) -> bool:
    """Whether it is a named effect of one or two columns that is not there."""
    effect = candidate.effect
    narrow = candidate.columns.stop - candidate.columns.start <= WIDEST
    return narrow and not effect.random and not isinstance(effect, Structure) and effect.name not in taken


def _along(problem: Problem, others: tuple[int, ...], item: Found, taken: Sequence[str]) -> list[int]:
    """The best form, beside others, of each effect that depends on the same variable and is not there."""
    worth = problem.gains(problem.explain(others)) - problem.penalties
    effects = {number: problem.offered[number].effect for number in problem.best_forms(worth)}
    return [
        number
        for number, effect in effects.items()
        if effect.depends_on == item.effect.depends_on and _may_join(problem.offered[number], taken)
    ]


def _with_one_less(tracer: Tracer[Any], trace: Trace) -> Iterator[tuple[str, Trace]]:
    """The trace without each thing that was found."""
    for name in (*trace.names, *(each.name for each in trace.components)):
        rest = trace.without(name)
        yield name, replace(rest, deviance=tracer.table.deviance(rest.forms, rest.noise))


def _elsewhere(tracer: Tracer[Any], others: Iterable[Trace]) -> Iterator[tuple[str, Trace]]:
    """Traces with other structure, each with its deviance."""
    for other in others:
        table = tracer.beside(other.components).table
        name = next(iter((*(each.name for each in other.components), *other.names)), "")
        yield name, replace(other, deviance=table.deviance(other.forms, other.noise))


def _course_for_walk(tracer: Tracer[Any], trace: Trace) -> Iterator[Neighbour]:
    """The trace with a course of the bias in time that has no shape in the place of its random walk, if it has one.

    Where there is structure in time beside the walk, it is neither: then one course stands for both, at even odds.
    """
    if WALK not in trace.names:
        return
    rest, structured = trace.without(WALK), [each for each in trace.components if each.place == WANDERING]
    for each in structured:
        rest = rest.without(each.name)
    table = tracer.beside(rest.components).table
    seen = seen_beside(table, rest.forms, rest.noise)
    for axis in table.axes:
        if axis.place == WANDERING:
            other = in_place(rest, Family(axis, FALSE_ALARM).best_course(seen))
            table = tracer.beside(other.components).table
            behind = table.deviance(other.forms, other.noise) - trace.deviance
            odds = 1.0 if structured else float(np.exp(-0.5 * max(behind, 0.0)))
            yield Neighbour(trace=other, odds=odds, differs=WALK)


def _shaped_otherwise(tracer: Tracer[Any], trace: Trace) -> Iterator[Trace]:
    for component in trace.components:
        if component.axis.expected:
            continue
        rest = trace.without(component.name)
        seen = seen_beside(tracer.beside(rest.components).table, rest.forms, rest.noise)
        for proposal in Family(component.axis, FALSE_ALARM).every(seen):
            if proposal.shape != component.shape and proposal.gain > 0.0:
                yield in_place(rest, proposal)
