"""Beyond the catalogue: structure without a name, where no set of named effects explains a table as well.

Components are looked for beside what the catalogue explains, beside nothing, and beside that with one effect away: what
has no name may have been taken for several that have one. After each the named effects are searched again beside it.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final, TypeVar

from tumble.calibrations.tracing.family import Proposal
from tumble.calibrations.tracing.fitting_noise import golden_section
from tumble.calibrations.tracing.gains import seen_beside
from tumble.calibrations.tracing.penalties import FALSE_ALARM, FOLLOWS_ANYTHING, NEAR, UNNAMED
from tumble.calibrations.tracing.scan import Scan
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace, Tracer, penalised_deviance, refined

MOST: Final = 2
"""So many components are looked for at most."""
_TRIED: Final = 3
"""So many of the most promising ones are searched beside."""
_MOST_ALIKE: Final = 6
"""So many others that explain as much are looked at."""
_WORTH_A_LOOK: Final = 10.0
"""What promises to be worse by more than this is not."""
_T = TypeVar("_T", bound=Table)


def traced(tracer: Tracer[_T]) -> tuple[Tracer[_T], Trace]:
    """What a table is traced to; with it the tracer in which that is at home."""
    trace = tracer.trace()
    if tracer.table.not_traced or not tracer.table.axes:
        return tracer, trace
    scan = Scan(tracer.table.axes, FALSE_ALARM)
    for _ in range(MOST):
        further = min(_with_one_more(tracer, scan, trace), key=_cost, default=trace)
        if _cost(further) >= _cost(trace):
            break
        trace = further
    return tracer.beside(trace.components), trace


def _cost(trace: Trace) -> float:
    """Penalised deviance, more of it for what follows any slow course in time."""
    courses = [each for each in trace.components if each.place == WANDERING and each.is_course]
    return penalised_deviance(trace) + FOLLOWS_ANYTHING * (bool(trace.noise.walk) + len(courses))


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
    """Every start with the component that promises most beside it."""
    for start in _starts(tracer, trace):
        table = tracer.beside(start.components).table
        seen = seen_beside(table, start.forms, start.noise)
        several = (each for each in scan.proposals(seen) if seen.rests_on_several_rows(each.component.columns))
        if (proposal := next(several, None)) is not None:
            yield start, proposal


def _starts(tracer: Tracer[Any], trace: Trace) -> Iterator[Trace]:
    """A trace, nothing, and the trace without each of what it names."""
    yield trace
    nothing = replace(trace, found=(), noise=tracer.noise)
    for each in trace.components:
        nothing = replace(nothing, noise=nothing.noise.with_level(each.name, dict(trace.noise.levels)[each.name]))
    alone = [] if trace.components else [trace.without(name) for name in trace.names]
    rests = [nothing, *alone] if trace.names or trace.noise != nothing.noise else []
    for rest in rests:
        table = tracer.beside(rest.components).table
        yield replace(rest, deviance=table.deviance(rest.forms, rest.noise))


def _beside(tracer: Tracer[Any], start: Trace, proposal: Proposal) -> Trace:
    """What a start turns into beside one component more."""
    component = proposal.component
    inside = tracer.beside((*start.components, component))
    noise = start.noise.with_level(component.name, proposal.variance)
    trial = replace(start, components=(*start.components, component))
    settled = inside.settled(noise, trial) if start.found else inside.searched(noise)
    return refined(inside.table, _fitted(inside.table, settled, component.name))


def _fitted(table: Table, trace: Trace, name: str) -> Trace:
    """A trace with the variance of one of its components as it fits best."""
    deviance, variance = table.deviance_by_noise(trace.forms), dict(trace.noise.levels)[name]
    ratio = golden_section(lambda ratio: deviance(trace.noise.with_level(name, variance * 10.0**ratio)), -1.0, 1.0, 8)
    noise = trace.noise.with_level(name, variance * 10.0**ratio)
    return replace(trace, noise=noise, deviance=deviance(noise))


def alike(tracer: Tracer[Any], trace: Trace) -> list[Trace]:
    """The trace with each other component, along another axis, that the rows do not part from its first one."""
    if not trace.components:
        return []
    first, *others = trace.components
    table, rest = tracer.beside(others).table, trace.without(first.name)
    scan = Scan(table.axes, FALSE_ALARM)
    proposals = scan.proposals(seen_beside(table, rest.forms, rest.noise))
    near = [each for each in proposals if each.worth > proposals[0].worth - NEAR and each.axis.name != first.axis.name]
    return [in_place(rest, each) for each in near[:_MOST_ALIKE]]


def in_place(rest: Trace, proposal: Proposal) -> Trace:
    """A trace with a component more, as it was proposed."""
    component = proposal.component
    noise = rest.noise.with_level(component.name, proposal.variance)
    return replace(rest, components=(component, *rest.components), noise=noise)
