"""A table traced to effects that each stand on evidence of their own; the others are withheld."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Generic, TypeVar

import numpy as np

from tumble.calibrations.tracing.beyond import traced
from tumble.calibrations.tracing.blocks import Lack
from tumble.calibrations.tracing.evidence import Evidence, gathered, settings_differ
from tumble.calibrations.tracing.fitting_noise import best_level
from tumble.calibrations.tracing.noise import SETTINGS, WHITE, scaled_levels
from tumble.calibrations.tracing.rivals import Rival, near_rivals, with_best_names
from tumble.calibrations.tracing.scan import Scan
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace, Tracer, nothing_found, refined, worth_their_penalty

_ROUNDS = 3
"""How often a table is traced again without what did not stand."""
_DIFFER_P = 0.01
"""Below this settings differ by more than their repeats, and that is a noise in which shapes are looked for."""
_CLEARLY_P = 1e-5
"""Below this they differ so clearly that shapes are compared in that noise even where nothing fell."""
_T = TypeVar("_T", bound=Table)


@dataclass(frozen=True, kw_only=True)
class Judged(Generic[_T]):
    """What a table was traced to, and on what that rests."""

    tracer: Tracer[_T]
    trace: Trace
    near: Mapping[str, Sequence[Rival]]
    """Near rivals of each effect of the trace."""
    nearly: tuple[Trace, ...] = ()
    """Other explanations, with structure without a name or in its place, that were nearly preferred."""
    scan: Scan
    """What of structure without a name was looked for."""
    evidence: Mapping[str, Evidence]
    """Of each effect of the trace that is no noise, by name."""
    withheld: tuple[Evidence, ...]
    """What would fit the rows, but does not stand: it is not stated."""

    @cached_property
    def lack(self) -> Lack:
        """What settings differ by beyond everything that was found."""
        return settings_differ(self.tracer.table, self.trace)


def judged(table: _T) -> Judged[_T]:
    """Trace a table.

    Where an effect does not stand, the table is traced again without it; where settings differ all the same, in a noise
    that their repeats share, so that a shape must explain more than their number allows.
    """
    whole, scan = Tracer(table), Scan(table.axes)
    first = traced(whole, scan)
    tracer, nearly = first.tracer, first.nearly
    trace, near = with_best_names(tracer, first.trace)
    withheld: dict[str, Evidence] = {}
    for further in reversed(range(_ROUNDS)):
        kept, found, fallen = _standing(tracer.table, trace)
        if not fallen:
            break
        withheld |= {each.name: withheld.get(each.name, each) for each in fallen}
        trace, near = kept, {name: near[name] for name in kept.names if name in near}
        if further:
            tracer, nearly, trace, near = _again(whole, scan, kept, frozenset(withheld))
    judgement = Judged(
        tracer=tracer.without(frozenset(withheld)),
        trace=trace,
        near=near,
        nearly=nearly,
        scan=scan,
        evidence=found,
        withheld=tuple(each for name, each in withheld.items() if name not in found),
    )
    if not withheld and trace.named and judgement.lack.alike < _CLEARLY_P:
        return replace(judgement, near=_near_in_levels(tracer, trace))
    return judgement


def untraced(table: _T) -> Judged[_T]:
    """What a table in doubt is traced to: nothing is looked for where nothing would be stated."""
    scan = Scan(table.axes)
    return Judged(tracer=Tracer(table), trace=nothing_found(table), near={}, scan=scan, evidence={}, withheld=())


def _standing(table: Table, trace: Trace) -> tuple[Trace, dict[str, Evidence], list[Evidence]]:
    """A trace without the effects that do not stand, taken out one by one, the least likely first.

    With what speaks for those that it has, and for those that fell.
    """
    found, fallen = gathered(table, trace), list[Evidence]()
    while failing := [each for each in found.values() if not each.stands]:
        worst = max(failing, key=lambda each: (each.p_value / each.chance, each.inflation))
        fallen.append(worst)
        trace = worth_their_penalty(table, refined(table, trace.without(worst.name)))
        found = gathered(table, trace)
    return trace, found, fallen


def _again(
    whole: Tracer[_T], scan: Scan, kept: Trace, barred: frozenset[str]
) -> tuple[Tracer[_T], tuple[Trace, ...], Trace, dict[str, list[Rival]]]:
    """Trace once more without some effects, in the noise by which settings differ if they do."""
    if not settings_differ(whole.beside(kept.components).table, kept).alike < _DIFFER_P:
        again = traced(whole.without(barred), scan)
        return again.tracer, again.nearly, *with_best_names(again.tracer, again.trace)
    rough = _with_levels(whole.table)
    again = traced(whole.among(rough, best_level(rough, kept.forms, WHITE, SETTINGS)).without(barred), scan)
    tracer, trace = again.tracer, again.trace
    noise = best_level(tracer.table, trace.forms, trace.noise, SETTINGS)
    deviance = tracer.table.deviance(trace.forms, noise)
    trace, near = with_best_names(tracer, replace(trace, noise=noise, deviance=deviance))
    smooth = whole.beside(trace.components)
    return smooth, (), _smooth(smooth.table, trace), _all_smooth(smooth.table, near)


def _near_in_levels(whole: Tracer[Any], trace: Trace) -> dict[str, list[Rival]]:
    """Rivals of what was found, in the noise by which settings differ: repeats of a setting part no two shapes."""
    table = whole.table
    rough = _with_levels(table)
    noise = best_level(rough, trace.forms, trace.noise, SETTINGS)
    trace = replace(trace, noise=noise, deviance=rough.deviance(trace.forms, noise))
    return _all_smooth(table, near_rivals(whole.among(rough, WHITE), trace))


def _all_smooth(table: Table, near: Mapping[str, Sequence[Rival]]) -> dict[str, list[Rival]]:
    return {name: [replace(each, trace=_smooth(table, each.trace)) for each in listed] for name, listed in near.items()}


def _with_levels(table: _T) -> _T:
    """The table with a noise that repeats of a setting share."""
    block = table.blocks("angle")
    columns = (block[:, None] == np.arange(block.max() + 1)).astype(float)
    return replace(table, memory=table.memory.with_levels({SETTINGS: scaled_levels(columns, table.weights)}))


def _smooth(table: Table, trace: Trace) -> Trace:
    """A trace without that noise, which is stated as what it is: settings that differ."""
    noise = trace.noise.without(SETTINGS)
    return replace(trace, noise=noise, deviance=table.deviance(trace.forms, noise))
