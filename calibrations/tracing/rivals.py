"""Which other effects would explain a table as well: found by putting each in the place of what was found."""

from dataclasses import dataclass, replace

from calibrations.effects.unnamed import Structure
from calibrations.tracing.problem import Problem
from calibrations.tracing.trace import Found, Trace, Tracer, found, refined_one

CLOSE = 3.84
"""Two explanations whose deviances differ by less cannot be told apart (chi-square, one degree of freedom, 95%)."""
_EQUAL = 1e-3
"""Deviances closer than this are equal: the effects are the same in this table."""
_WORTH_A_LOOK = 20.0
"""A third of what an effect may promise less than the most promising one before it is passed over."""


@dataclass(frozen=True, kw_only=True)
class Rival:
    """Another effect in the place of a found one."""

    found: Found
    behind: float
    """Deviance beyond that of the trace, 2 added for each coefficient more; negative for a better one."""
    dearer: float
    """Deviance and entry beyond those of what it replaces: what decides which of the two gives its name."""


def with_best_names(tracer: Tracer, trace: Trace) -> Trace:
    """Exchange effects for rivals that are cheaper, or equal and first in the catalogue, one after the other."""
    for _ in range(2 * len(trace.named)):
        better = [
            (rival.dearer, name, rival)
            for name in names(trace)
            for rival in rivals(tracer, trace, name)
            if _goes_before(tracer, rival, name)
        ]
        if not better:
            break
        _, name, rival = min(better, key=lambda item: item[0])
        found = (*(item for item in trace.found if item.effect.name != name), rival.found)
        deviance = tracer.ground.deviance([item.form for item in found], trace.noise)
        trace = replace(trace, found=found, deviance=deviance)
    return trace


def _goes_before(tracer: Tracer, rival: Rival, name: str) -> bool:
    """Whether a rival is cheaper, or costs the same and stands first in the catalogue."""
    if abs(rival.dearer) > _EQUAL:
        return rival.dearer < 0
    order = [effect.name for effect in tracer.effects]
    return order.index(rival.found.effect.name) < order.index(name)


def rivals(tracer: Tracer, trace: Trace, name: str) -> list[Rival]:
    """Every effect that could stand in the place of the one called `name`, the closest first."""
    others = [item for item in trace.found if item.effect.name != name]
    replaced = [item for item in trace.found if item.effect.name == name]
    coefficients, entry = sum(item.coefficients for item in replaced), sum(item.entry for item in replaced)
    forms = [item.form for item in others]
    taken = {item.effect.name for item in trace.found}
    listed = []
    for rough in _best_forms(tracer.problem(trace.noise), tuple(item.number for item in others)):
        if rough.effect.name in taken or isinstance(rough.effect, Structure):
            continue
        fine = refined_one(tracer.ground, rough, forms, trace.noise)
        excess = tracer.ground.deviance([*forms, fine.form], trace.noise) - trace.deviance
        behind = excess + 2.0 * (fine.coefficients - coefficients)
        listed.append(Rival(found=fine, behind=behind, dearer=excess + fine.entry - entry))
    order = {effect.name: place for place, effect in enumerate(tracer.effects)}
    return sorted(listed, key=lambda rival: (round(rival.behind / _EQUAL), order[rival.found.effect.name]))


def _best_forms(problem: Problem, others: tuple[int, ...]) -> list[Found]:
    """The form of each effect that promises most beside the others, leaving out effects that promise nothing near."""
    gains = problem.gains(problem.explain(others))
    most = float(gains.max(initial=0.0))
    best: dict[str, int] = {}
    for number, candidate in enumerate(problem.offered):
        name = candidate.effect.name
        if gains[number] > most - 3 * _WORTH_A_LOOK and gains[number] > gains[best.get(name, number)] - 1e-12:
            best[name] = number
    return [found(problem, number) for number in best.values()]


def names(trace: Trace) -> list[str]:
    """Names of the effects found, each once."""
    return list(dict.fromkeys(item.effect.name for item in trace.named))
