"""What tracing found in a table, as it is reported."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import chdtrc

from tumble.calibrations.tracing.courses import Course
from tumble.calibrations.tracing.effect import Quantity, Variable
from tumble.calibrations.tracing.judged import Judged
from tumble.calibrations.tracing.noise import WALK
from tumble.calibrations.tracing.quantified import Quantified, level_quantities
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace
from tumble.calibrations.tracing.variables import VARIABLE_WORDS


@dataclass(frozen=True, kw_only=True)
class EffectFound:
    """An effect of the catalogue that the data shows."""

    name: str
    also_possible: tuple[str, ...]
    belongs_to: str
    coefficients: Mapping[str, Quantity]
    p_value: float
    depends_on: Variable | None = None
    """What its evidence rests on, where that is known."""


@dataclass(frozen=True, kw_only=True)
class Unexplained:
    """Structure that is there and that no effect of the catalogue explains."""

    depends_on: str
    description: str
    shaped: bool = True
    """Whether it has a shape, which was taken into account; settings that are too few differ in none."""
    channel: str = ""
    """What of the model changes: offset, scale or angle; empty where that is not known."""
    variable: str = ""
    """With what, more closely than `depends_on`."""
    also_possible: tuple[tuple[str, str], ...] = ()
    """Other channels and variables that the rows do not part from these."""
    courses: tuple[Course, ...] = ()
    """What is known of it, the first one along its channel and variable; none where it has no shape."""


def unexplained(trace: Trace, others: Sequence[Trace] = (), known: Sequence[Course] = ()) -> Unexplained | None:
    """Structure of a trace that no effect of the catalogue explains, and what `others` could stand for it.

    `known` are the courses of its components. None where there is none.
    """
    if not trace.components:
        return None
    first = trace.components[0]
    channel, variable = first.place
    places = dict.fromkeys(other.components[0].place for other in others)
    return Unexplained(
        depends_on=VARIABLE_WORDS[first.depends_on],
        description=first.described,
        channel=channel,
        variable=variable,
        also_possible=tuple(place for place in places if place != first.place),
        courses=tuple(known),
    )


SHAPELESS_P = 1e-5
"""Below this settings that differ by more than their repeats, in no shape, are said to be unexplained."""


@dataclass(frozen=True, kw_only=True)
class Withheld:
    """An effect that would fit the rows and is not stated."""

    name: str
    reason: str
    """In words that go after its name."""


def effects_found(
    table: Table, found: Judged[Any], best: Quantified, close: Mapping[str, Sequence[Rival]]
) -> list[EffectFound]:
    """Every named effect of a trace with its coefficients; `close` holds the rivals of each that remain."""
    return [_effect(table, found, best, name, close[name]) for name in found.trace.names]


def _effect(table: Table, found: Judged[Any], best: Quantified, name: str, close: Sequence[Rival]) -> EffectFound:
    trace = found.trace
    word = _word(table, name)
    others = dict.fromkeys(_word(table, rival.name) for rival in close)
    return EffectFound(
        name=word,
        also_possible=tuple(other for other in others if other != word),
        belongs_to=_owner(table, name),
        coefficients=_coefficients(table, trace, best, name),
        p_value=found.evidence[name].p_value if name in found.evidence else _chance(table, trace, name),
        depends_on=next((effect.depends_on for effect in table.effects if effect.name == name), None),
    )


def _chance(table: Table, trace: Trace, name: str) -> float:
    """Of what is a noise: one variance, by its likelihood."""
    rest = trace.without(name)
    return float(chdtrc(1, max(table.deviance(rest.forms, rest.noise) - trace.deviance, 0.0)))


def withheld(table: Table, found: Judged[Any]) -> tuple[Withheld, ...]:
    """Effects of the catalogue that would fit the rows and are not stated."""
    return tuple(
        Withheld(name=_word(table, each.name), reason=each.reason) for each in found.withheld if not each.unnamed
    )


def _word(table: Table, name: str) -> str:
    """How an effect is called in a result."""
    if name == WALK:
        return table.walk
    return next((effect.word for effect in table.effects if effect.name == name), name)


def _owner(table: Table, name: str) -> str:
    return "unit" if name == WALK else next(effect.belongs_to for effect in table.effects if effect.name == name)


def _coefficients(table: Table, trace: Trace, best: Quantified, name: str) -> Mapping[str, Quantity]:
    if name == WALK:
        return _walk(table, trace, best)
    if any(item.effect.name == name for item in trace.found):
        return best.quantities(name)
    effect = next(effect for effect in table.effects if effect.name == name)
    return level_quantities(table, trace, best, effect)


def _walk(table: Table, trace: Trace, best: Quantified) -> Mapping[str, Quantity]:
    """Random walk: the variance of the first mode is q T / π² (Karhunen-Loève expansion of the centred walk).

    The variance is taken from a grid, so that no uncertainty is stated.
    """
    hours = table.scene.hours
    span_h = float(np.ptp(hours)) if hours is not None else 1.0
    rate = float(best.dwell * np.pi * np.sqrt(trace.noise.walk / span_h))
    return {table.walk: Quantity(value=rate, standard_uncertainty=None, unit=f"{table.unit}/√h")}
