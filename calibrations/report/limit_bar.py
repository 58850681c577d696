"""A value against its limits, described: where everything lies along a bar. Paper and window draw it."""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Final

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import Outcome

_BEYOND: Final = 0.18
"""Of the bar, left free outside of the limits."""
_EDGE: Final = 0.03
"""Of the bar: what lies farther outside is drawn so near to its end."""


@dataclass(frozen=True, kw_only=True)
class LimitBar:
    """Places along a bar, as parts of its length from 0 to 1."""

    minimum: float | None
    """None where that side is open."""
    maximum: float | None
    value: float | None
    """None where there is no value."""
    interval: tuple[float, float]
    """Ends of the 95% interval; both at the value where none is known."""
    beyond: int
    """-1 or 1 where the value lies beyond that end of the bar, and its mark stands at the end; else 0."""
    outcome: Outcome

    @property
    def inside(self) -> tuple[float, float]:
        """The part between the limits."""
        return (0.0 if self.minimum is None else self.minimum, 1.0 if self.maximum is None else self.maximum)


def limit_bar(parameter: Parameter, check: LimitCheck, outcome: Outcome) -> LimitBar:
    """Describe the bar of a parameter; an open side is as long as it takes."""
    low, high = _ends(parameter, check)

    def across(number: float) -> float:
        return (number - low) / (high - low)

    value = parameter.value
    begin, end = parameter.interval_95 or (value or 0.0, value or 0.0)
    return LimitBar(
        minimum=None if check.minimum is None else across(check.minimum),
        maximum=None if check.maximum is None else across(check.maximum),
        value=None if value is None else _kept(across(value)),
        interval=(_kept(across(begin)), _kept(across(end))),
        beyond=0 if value is None else _side(across, value),
        outcome=outcome,
    )


def _kept(place: float) -> float:
    return min(max(place, _EDGE), 1.0 - _EDGE)


def _side(across: Callable[[float], float], value: float) -> int:
    return (across(value) > 1.0 - _EDGE) - (across(value) < _EDGE)


def _ends(parameter: Parameter, check: LimitCheck) -> tuple[float, float]:
    """What the left and the right end stand for."""
    low, high = check.minimum, check.maximum
    reach = [each for each in (parameter.value, *(parameter.interval_95 or ())) if each is not None and isfinite(each)]
    if low is None or high is None:
        limit = low if low is not None else high or 0.0
        width = max([abs(each - limit) for each in reach] or [0.0]) or abs(limit) or 1.0
        low, high = (low, low + width * 1.2) if low is not None else (limit - width * 1.2, limit)
    margin = _BEYOND / (1.0 - 2 * _BEYOND) * ((high - low) or abs(high) or 1.0)
    return low - margin, high + margin
