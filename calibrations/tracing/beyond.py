"""Beyond the catalogue: structure without a name, where no set of named effects explains a table as well.

Components are looked for beside what the catalogue explains, beside nothing, and beside that with one effect away: what
has no name may have been taken for several that have one. After each the named effects are searched again beside it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Final, Generic, TypeVar

from tumble.calibrations.tracing.family import Proposal
from tumble.calibrations.tracing.fitting_noise import golden_section
from tumble.calibrations.tracing.gains import seen_beside
from tumble.calibrations.tracing.penalties import FOLLOWS_ANYTHING, NEAR, UNNAMED
from tumble.calibrations.tracing.scan import Scan
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace, Tracer, penalised_deviance, refined, worth_their_penalty

MOST: Final = 2
"""So many components are looked for at most."""
_TRIED: Final = 3
"""So many of the most promising ones are searched beside."""
_MOST_ALIKE: Final = 6
"""So many others that explain as much are looked at."""
_WORTH_A_LOOK: Final = 10.0
"""What promises to be worse by more than this is not."""
_T = TypeVar("_T", bound=Table)


@dataclass(frozen=True, kw_only=True)
class Traced(Generic[_T]):
    """What a table is traced to."""

    tracer: Tracer[_T]
    """In which that is at home."""
    trace: Trace
    nearly: tuple[Trace, ...] = ()
    """What was held against it and explains nearly as much: other components, or names in the place of components."""


def traced(tracer: Tracer[_T], scan: Scan) -> Traced[_T]:
    """Trace a table to named effects, and to structure without a name where that explains more."""
    trace = tracer.trace()
    if tracer.table.not_traced or not tracer.table.axes:
        return Traced(tracer=tracer, trace=trace)
    tried = [trace]
    for _ in range(MOST):
        further = list(_with_one_more(tracer, scan, trace))
        tried.extend(further)
        best = min((trace, *further), key=_cost)
        if best is trace:
            break
        trace = best
    limit = _cost(trace) + NEAR
    nearly = tuple(each for each in tried if each is not trace and _cost(each) < limit)
    return Traced(tracer=tracer.beside(trace.components), trace=trace, nearly=nearly)


def _cost(trace: Trace) -> float:
    """Penalised deviance, more of it for what follows any slow course in time, and for names beside a like structure.

    An effect along a variable that structure without a name follows too may be a part of that: it must be worth as much
    more as structure must be where a name would do.
    """
    courses = [each for each in trace.components if each.place == WANDERING and each.is_course]
    followed = {each.depends_on for each in trace.components}
    parts = sum(item.effect.depends_on in followed for item in trace.named)
    slow = bool(trace.noise.walk) + len(courses)
    return penalised_deviance(trace) + FOLLOWS_ANYTHING * slow + UNNAMED * parts


WANDERING: Final = ("offset", "time")
"""Channel and variable of a bias that wanders."""


def _with_one_more(tracer: Tracer[Any], scan: Scan, trace: Trace) -> Iterator[Trace]:
    """The trace with one component more, what it names searched again beside it."""
    promised = sorted(
        ((penalised_deviance(start) - proposal.worth + UNNAMED, number, start, proposal)
         for number, (start, proposal) in enumerate(_proposed(tracer, scan, trace))),
    )  # fmt: skip
    limit = penalised_deviance(trace) + _WORTH_A_LOOK
    for expected, _, start, proposal in promised[:_TRIED]:
        if expected < limit:
            yield _beside(tracer, start, proposal)


def _proposed(tracer: Tracer[Any], scan: Scan, trace: Trace) -> Iterator[tuple[Trace, Proposal]]:
    """Every start with the component that promises most beside it; beside less than a trace, the foremost axes do."""
    others = (*_nothing(tracer, trace), *_with_one_less(tracer, trace))
    starts = [(trace, scan.proposals), *((other, scan.foremost) for other in others)]
    for start, proposals in starts:
        seen = seen_beside(tracer.beside(start.components).table, start.forms, start.noise)
        several = (each for each in proposals(seen) if seen.rests_on_several_rows(each.component.columns))
        if (proposal := next(several, None)) is not None:
            yield start, proposal


def _nothing(tracer: Tracer[Any], trace: Trace) -> Iterator[Trace]:
    """A trace without anything that it names, if it names anything."""
    noise = tracer.noise
    for each in trace.components:
        noise = noise.with_level(each.name, dict(trace.noise.levels)[each.name])
    if trace.names or trace.noise != noise:
        yield _judged_anew(tracer, replace(trace, found=(), noise=noise))


def _with_one_less(tracer: Tracer[Any], trace: Trace) -> Iterator[Trace]:
    """A trace of several names without each of them."""
    if not trace.components and len(trace.names) > 1:
        for name in trace.names:
            yield _judged_anew(tracer, trace.without(name))


def _judged_anew(tracer: Tracer[Any], trace: Trace) -> Trace:
    table = tracer.beside(trace.components).table
    return replace(trace, deviance=table.deviance(trace.forms, trace.noise))


def _beside(tracer: Tracer[Any], start: Trace, proposal: Proposal) -> Trace:
    """What a start turns into beside one component more."""
    component = proposal.component
    inside = tracer.beside((*start.components, component))
    noise = start.noise.with_level(component.name, proposal.variance)
    trial = replace(start, components=(*start.components, component))
    settled = inside.settled(noise, trial) if start.found else inside.searched(noise)
    return worth_their_penalty(inside.table, refined(inside.table, _fitted(inside.table, settled, component.name)))


def _fitted(table: Table, trace: Trace, name: str) -> Trace:
    """A trace with the variance of one of its components as it fits best."""
    deviance, variance = table.deviance_by_noise(trace.forms), dict(trace.noise.levels)[name]
    ratio = golden_section(lambda ratio: deviance(trace.noise.with_level(name, variance * 10.0**ratio)), -1.0, 1.0, 8)
    noise = trace.noise.with_level(name, variance * 10.0**ratio)
    return replace(trace, noise=noise, deviance=deviance(noise))


def alike(tracer: Tracer[Any], trace: Trace, scan: Scan) -> list[Trace]:
    """The trace with each other component, along another axis, that the rows do not part from its first one."""
    if not trace.components:
        return []
    first, *others = trace.components
    table, rest = tracer.beside(others).table, trace.without(first.name)
    proposals = scan.proposals(seen_beside(table, rest.forms, rest.noise))
    near = [each for each in proposals if each.worth > proposals[0].worth - NEAR and each.axis.name != first.axis.name]
    return [in_place(rest, each) for each in near[:_MOST_ALIKE]]


def in_place(rest: Trace, proposal: Proposal) -> Trace:
    """A trace with a component more, as it was proposed."""
    component = proposal.component
    noise = rest.noise.with_level(component.name, proposal.variance)
    return replace(rest, components=(component, *rest.components), noise=noise)
