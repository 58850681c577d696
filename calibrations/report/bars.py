"""A value against its limits, as a bar that fits into a line of a table."""

from typing import Final

from markupsafe import Markup

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import Outcome

_WIDE: Final = 120.0
_HIGH: Final = 16.0
_BEYOND: Final = 0.18
"""Of the width, left free outside of the limits."""
_INSIDE: Final = "#d7e8df"
_COLOURS: Final = {Outcome.PASS: "#00795a", Outcome.FAIL: "#b34a00"}
_UNDECIDED: Final = "#5a616b"


def limit_bar(parameter: Parameter, check: LimitCheck, outcome: Outcome) -> Markup:
    """What is between the limits, shaded, and the value with its 95% interval over it; none where it has no value.

    What lies far outside is drawn at the edge.
    """
    low, high = _ends(parameter, check)
    first = _BEYOND if check.minimum is not None else 0.0
    last = 1.0 - _BEYOND if check.maximum is not None else 1.0
    parts = [f'<path d="M{first * _WIDE:g} 2H{last * _WIDE:g}V{_HIGH - 2:g}H{first * _WIDE:g}z" fill="{_INSIDE}"/>']
    parts += [
        f'<path d="M{part * _WIDE:g} 1V{_HIGH - 1:g}" stroke="#666" stroke-width="1.2"/>'
        for part, limit in ((first, check.minimum), (last, check.maximum))
        if limit is not None
    ]

    def across(number: float) -> float:
        return min(max((number - low) / (high - low), 0.03), 0.97) * _WIDE

    if parameter.value is not None:
        colour = _COLOURS.get(outcome, _UNDECIDED)
        begin, end = parameter.interval_95 or (parameter.value, parameter.value)
        middle = _HIGH / 2
        parts.append(
            f'<path d="M{across(begin):.1f} {middle:g}H{across(end):.1f}" stroke="{colour}" stroke-width="2"/>'
            f'<circle cx="{across(parameter.value):.1f}" cy="{middle:g}" r="3.4" fill="{colour}"/>'
        )
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" class="bar" aria-hidden="true" width="{_WIDE:g}" height="{_HIGH:g}" '
        f'viewBox="0 0 {_WIDE:g} {_HIGH:g}">{"".join(parts)}</svg>'
    )


def _ends(parameter: Parameter, check: LimitCheck) -> tuple[float, float]:
    """What the left and the right edge stand for; an open side is as wide as it takes."""
    low, high = check.minimum, check.maximum
    reach = [each for each in (parameter.value, *(parameter.interval_95 or ())) if each is not None]
    if low is None or high is None:
        limit = low if low is not None else high or 0.0
        width = max([abs(each - limit) for each in reach] or [0.0]) or abs(limit) or 1.0
        low, high = (low, low + width * 1.2) if low is not None else (limit - width * 1.2, limit)
    margin = _BEYOND / (1.0 - 2 * _BEYOND) * ((high - low) or abs(high) or 1.0)
    return low - margin, high + margin
