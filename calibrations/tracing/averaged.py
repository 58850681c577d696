"""Intervals that hold over every explanation near the one that is stated, each by its odds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Final

import numpy as np

from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.mixtures import Part, interval_95
from tumble.calibrations.core.parameter import Parameter
from tumble.messages import Message

_MATERIAL: Final = 0.05
"""What widens an interval by less than this part is left out."""


@dataclass(frozen=True, kw_only=True)
class Said:
    """What an explanation says of the parameters, by name; of those that it leaves open, nothing."""

    odds: float
    """Against the explanation that is stated."""
    values: Mapping[str, float]
    deviations: Mapping[str, float]
    """By the scatter of the data alone."""


@dataclass(frozen=True, kw_only=True)
class Reach:
    """By how much a parameter may be less, and more, than any explanation says: it is what it is at a place unknown."""

    below: float = 0.0
    """Not above 0."""
    above: float = 0.0


def averaged(
    parameters: Mapping[str, Parameter],
    said: Sequence[Said],
    bounds: Mapping[str, tuple[float, float]],
    reaches: Mapping[str, Reach] = MappingProxyType({}),
) -> tuple[dict[str, Parameter], tuple[BudgetLine, ...]]:
    """The same parameters, their uncertainty widened by what other explanations say, and the line of that in a budget.

    Beyond its `bounds`, of those that have any, a parameter lies by no explanation; of those with a `Reach` the
    interval holds at every place. No line where nothing is widened.
    """
    after = {
        name: _widened(parameter, [each for each in said if name in each.values], bounds.get(name), reaches.get(name))
        for name, parameter in parameters.items()
    }
    added = {name: _added(parameters[name], widened) for name, widened in after.items() if widened.value is not None}
    if not any(added.values()):
        return dict(parameters), ()
    line = BudgetLine(
        name=Message("explanations that fit nearly as well"),
        kind="B",
        symbol=Message.counted("{count} explanation", "{count} explanations", count=len(said) + bool(reaches)),
        contributions=added,
        degrees_of_freedom=float("inf"),
    )
    return after, (line,)


def _added(before: Parameter, after: Parameter) -> float:
    """By how much more a standard uncertainty is, in squares."""
    return float(
        np.sqrt(max((after.standard_uncertainty or 0.0) ** 2 - (before.standard_uncertainty or 0.0) ** 2, 0.0))
    )


def _widened(
    parameter: Parameter, said: Sequence[Said], bounds: tuple[float, float] | None, reach: Reach | None
) -> Parameter:
    if parameter.value is None or parameter.interval_95 is None or not parameter.type_a:
        return parameter
    name = parameter.name
    parts = [_part(parameter, 1.0, parameter.value, parameter.type_a, bounds)]
    parts += [_part(parameter, each.odds, each.values[name], each.deviations[name], bounds) for each in said]
    low, high = interval_95(parts, parameter.degrees_of_freedom or 1.0)
    own_low, own_high = parameter.interval_95
    reach = reach or Reach()
    low, high = min(low, own_low) + reach.below, max(high, own_high) + reach.above
    wider = (high - low) / (own_high - own_low)
    if wider < 1.0 + _MATERIAL:
        return parameter
    uncertainty = wider * (parameter.standard_uncertainty or 0.0)
    return replace(parameter, standard_uncertainty=uncertainty, interval_95=(low, high))


def _part(
    parameter: Parameter, odds: float, value: float, deviation: float, bounds: tuple[float, float] | None
) -> Part:
    """What an explanation says: the interval of the parameter, moved, and wider or narrower by the scatter."""
    assert parameter.value is not None and parameter.interval_95 is not None, "such were left out"
    low, high = parameter.interval_95
    type_a, u = parameter.type_a or 0.0, parameter.standard_uncertainty or 0.0
    ratio = np.sqrt(max(u**2 - type_a**2 + deviation**2, 0.0)) / u
    low, high = value - ratio * (parameter.value - low), value + ratio * (high - parameter.value)
    if bounds is not None:
        low, high = max(low, bounds[0]), min(high, bounds[1])
    return Part(odds=odds, value=value, low=low, high=high)
