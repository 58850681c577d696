"""What tracing found in a table, as it is reported."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

from calibrations.effects.effect import Quantity, Structure
from calibrations.tracing.quantified import Quantified, level_quantities
from calibrations.tracing.rivals import Rival
from calibrations.tracing.table import Table
from calibrations.tracing.trace import WALK, Trace


@dataclass(frozen=True, kw_only=True)
class EffectFound:
    """An effect of the catalogue that the data shows."""

    name: str
    also_possible: tuple[str, ...]
    belongs_to: str
    coefficients: Mapping[str, Quantity]
    p_value: float


@dataclass(frozen=True, kw_only=True)
class Unexplained:
    """Structure that is there and that no effect of the catalogue explains."""

    depends_on: str
    description: str


def effects_found(
    table: Table, trace: Trace, best: Quantified, close: Mapping[str, Sequence[Rival]]
) -> list[EffectFound]:
    """Every named effect of a trace with its coefficients; `close` holds the rivals of each that remain."""
    return [_effect(table, trace, best, name, close[name]) for name in trace.names]


def _effect(table: Table, trace: Trace, best: Quantified, name: str, close: Sequence[Rival]) -> EffectFound:
    rest = trace.without(name)
    gain = table.deviance(rest.forms, rest.noise) - trace.deviance
    width = sum(item.form.columns.shape[1] for item in trace.found if item.effect.name == name) or 1
    word = _word(table, name)
    others = dict.fromkeys(_word(table, rival.name) for rival in close)
    return EffectFound(
        name=word,
        also_possible=tuple(other for other in others if other != word),
        belongs_to=_owner(table, name),
        coefficients=_coefficients(table, trace, best, name),
        p_value=float(chdtrc(width, max(gain, 0.0))),
    )


def _word(table: Table, name: str) -> str:
    """How an effect is called in a result."""
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
    return {WALK: Quantity(value=rate, standard_uncertainty=None, unit=f"{table.unit}/√h")}


def unexplained(trace: Trace) -> Unexplained | None:
    """Structure that no effect of the catalogue explains; None where there is none."""
    if not trace.unnamed:
        return None
    structures = [item for item in trace.unnamed if isinstance(item.effect, Structure)]
    first = structures[0]
    assert isinstance(first.effect, Structure)
    return Unexplained(depends_on=first.effect.depends_on, description=first.effect.describe(first.form))
