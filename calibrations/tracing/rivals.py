"""Which other effects would explain a table as well: found by putting each in the place of what was found."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

from tumble.calibrations.tracing.effect import Structure
from tumble.calibrations.tracing.fitting_noise import best_level, best_walk
from tumble.calibrations.tracing.noise import WALK
from tumble.calibrations.tracing.penalties import NEAR, SIMPLER, WALK_NAMED
from tumble.calibrations.tracing.problem import Problem
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Found, Trace, Tracer, found, penalised_deviance, refined, refined_one

_EQUAL = 1e-3
"""Deviances closer than this are equal: the effects are the same in this table."""
_WORTH_A_LOOK = 60.0
"""An effect that promises less than the most promising one by more is passed over."""
_MAY_COME_NEAR: Final = 2.0 * NEAR
"""One that is further behind does not come near once the other effects are refined beside it."""


@dataclass(frozen=True, kw_only=True)
class Rival:
    """Another effect in the place of a found one."""

    name: str
    trace: Trace
    """The whole explanation with the rival in it."""
    found: Found | None
    """The rival as columns; None where it is autocorrelated noise."""
    behind: float
    """Deviance beyond that of the trace, 2 added for each coefficient more; negative for a better one."""
    naming_difference: float
    """Naming penalty beyond that of the trace: it decides which of the two gives its name."""


def with_best_names(tracer: Tracer[Any], trace: Trace) -> tuple[Trace, dict[str, list[Rival]]]:
    """Exchange effects for rivals that are cheaper, or equal and first in the catalogue, one after the other.

    Returns the trace, and the rivals of each of its effects that are near.
    """
    put_aside: dict[str, tuple[Found, ...]] = {}
    while True:
        listed = {name: rivals(tracer, trace, name) for name in trace.names}
        better = [
            (rival, name)
            for name, others in listed.items()
            for rival in others
            if _goes_before(tracer, rival, name) and _explains(tracer, trace.without(name), rival)
        ]
        if not better:
            break
        first, name = min(better, key=lambda each: each[0].naming_difference)
        forms = tuple(item for item in trace.found if item.effect.name == name)
        if before := forms if len(forms) > 1 else put_aside.pop(name, ()):
            put_aside[first.name] = before
        trace = first.trace
    for name, forms in put_aside.items():
        if name in listed and forms[0].effect.name not in trace.names:
            listed[name] = sorted([*listed[name], put_back(tracer, trace, name, forms)], key=lambda each: each.behind)
    return trace, _near(listed)


def put_back(tracer: Tracer[Any], trace: Trace, name: str, forms: Sequence[Found]) -> Rival:
    """An effect in several forms that was exchanged for a simpler one called `name`, in its place again."""
    rest = trace.without(name)
    trial = refined(tracer.table, replace(rest, found=(*rest.found, *forms)))
    replaced = sum(item.coefficients for item in trace.found if item.effect.name == name) or 1
    coefficients = sum(item.coefficients for item in forms) - replaced
    return Rival(
        name=forms[0].effect.name,
        trace=trial,
        found=forms[0],
        behind=trial.deviance - trace.deviance + 2.0 * coefficients,
        naming_difference=_naming_penalty(trial) - _naming_penalty(trace),
    )


def near_rivals(tracer: Tracer[Any], trace: Trace) -> dict[str, list[Rival]]:
    """The rivals of each effect of a trace that are near."""
    return _near({name: rivals(tracer, trace, name) for name in trace.names})


def _near(listed: Mapping[str, Sequence[Rival]]) -> dict[str, list[Rival]]:
    return {name: [rival for rival in others if rival.behind < NEAR] for name, others in listed.items()}


def _goes_before(tracer: Tracer[Any], rival: Rival, name: str) -> bool:
    """Whether a rival is cheaper, or costs the same and stands first in the catalogue; one that is barred never."""
    if rival.name in tracer.barred:
        return False
    if abs(rival.naming_difference) > _EQUAL:
        return rival.naming_difference < 0
    order = [*(effect.name for effect in tracer.effects), WALK]
    return order.index(rival.name) < order.index(name)


def _explains(tracer: Tracer[Any], rest: Trace, rival: Rival) -> bool:
    """Whether levels are worth their penalty; those that explain nothing would be the simplest of all."""
    if rival.found is not None:
        return True
    nothing = replace(rest, deviance=tracer.table.deviance(rest.forms, rest.noise))
    return penalised_deviance(rival.trace) < penalised_deviance(nothing)


def _naming_penalty(trace: Trace) -> float:
    """Penalised deviance of a trace, with a penalty for each coefficient.

    It only ever falls, or stays while names move up in the catalogue, so that exchanging names comes to an end.
    """
    penalised = penalised_deviance(trace) + SIMPLER * sum(item.coefficients for item in trace.found)
    return penalised + (SIMPLER + WALK_NAMED) * bool(trace.noise.walk)


def rivals(tracer: Tracer[Any], trace: Trace, name: str, asked: Collection[str] = ()) -> list[Rival]:
    """Every effect that could stand in the place of the one called `name`, the closest first.

    Of one that was found in two forms, in the place of either too. Those that promise nothing near are left out, but
    for the ones that are `asked` for.
    """
    forms = [item for item in trace.found if item.effect.name == name]
    order = {effect.name: place for place, effect in enumerate(tracer.effects)}
    listed = sorted(
        (*_in_place_of(tracer, trace, trace.without(name), forms, asked), *_of_one_form(tracer, trace, forms)),
        key=lambda rival: (round(rival.behind / _EQUAL), order.get(rival.name, len(order))),
    )
    closest: dict[str, Rival] = {}
    for rival in listed:
        closest.setdefault(rival.name, rival)
    return list(closest.values())


def _of_one_form(tracer: Tracer[Any], trace: Trace, forms: Sequence[Found]) -> Iterator[Rival]:
    """What is near in the place of one of several forms: a drift of the slower of two warm-ups."""
    for form in forms if len(forms) > 1 else ():
        for rival in _in_place_of(tracer, trace, trace.without_form(form), [form], ()):
            if rival.behind < NEAR:
                yield rival


def _in_place_of(
    tracer: Tracer[Any], trace: Trace, rest: Trace, replaced: Sequence[Found], asked: Collection[str]
) -> Iterator[Rival]:
    """Every effect that could stand for what was replaced, beside the rest."""
    coefficients = sum(item.coefficients for item in replaced) or 1
    for item, trial in _refined(tracer.table, trace, _in_place(tracer, rest, trace.names, asked)):
        yield Rival(
            name=trial.names[-1] if item is None else item.effect.name,
            trace=trial,
            found=item,
            behind=trial.deviance - trace.deviance + 2.0 * ((item.coefficients if item else 1) - coefficients),
            naming_difference=_naming_penalty(trial) - _naming_penalty(trace),
        )


def _refined(
    table: Table, trace: Trace, trials: Iterable[tuple[Found | None, Trace]]
) -> Iterator[tuple[Found | None, Trace]]:
    """Those that may come near, with what was scanned for the other effects where it fits best beside them."""
    for item, trial in trials:
        near = item is not None and trial.deviance < trace.deviance + _MAY_COME_NEAR
        yield item, _others_refined(table, trial) if near else trial


def _others_refined(table: Table, trial: Trace) -> Trace:
    """A trace with all effects but the last moved to where they fit best beside it."""
    found = list(trial.found)
    for place, item in enumerate(found[:-1]):
        others = [other.form for other in (*found[:place], *found[place + 1 :])]
        found[place] = refined_one(table, item, others, trial.noise)
    deviance = table.deviance([item.form for item in found], trial.noise)
    return replace(trial, found=tuple(found), deviance=deviance)


def _in_place(
    tracer: Tracer[Any], rest: Trace, taken: tuple[str, ...], asked: Collection[str]
) -> Iterator[tuple[Found | None, Trace]]:
    """The rest of an explanation with each effect that promises anything, refined."""
    table = tracer.table
    for rough in _best_forms(tracer.problem(rest.noise), tuple(item.number for item in rest.found), asked):
        effect = rough.effect
        if effect.name in taken:
            continue
        if effect.random:
            noise = best_level(table, rest.forms, rest.noise, effect.name)
            yield None, replace(rest, noise=noise, deviance=table.deviance(rest.forms, noise))
            continue
        fine = refined_one(table, rough, rest.forms, rest.noise)
        deviance = table.deviance([*rest.forms, fine.form], rest.noise)
        yield fine, replace(rest, found=(*rest.found, fine), deviance=deviance)
    if WALK not in taken and table.memory.modes.shape[1]:
        noise, deviance = best_walk(table, rest.forms, rest.noise)
        yield None, replace(rest, noise=noise, deviance=deviance)


def _best_forms(problem: Problem, others: tuple[int, ...], asked: Collection[str]) -> list[Found]:
    """The form of each effect that promises most beside the others, if it promises something near or is asked for."""
    gains = problem.gains(problem.explain(others))
    named = [number for number, candidate in enumerate(problem.offered) if not isinstance(candidate.effect, Structure)]
    most = float(gains[named].max(initial=0.0))
    best: dict[str, int] = {}
    for number in named:
        name = problem.offered[number].effect.name
        near = gains[number] > most - _WORTH_A_LOOK or name in asked
        if near and gains[number] > gains[best.get(name, number)] - 1e-12:
            best[name] = number
    return [found(problem, number) for number in best.values()]
