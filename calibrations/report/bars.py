"""A value against its limits, drawn as a bar that fits into a line of a table."""

from typing import Final

from markupsafe import Markup

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.report.limit_bar import LimitBar

_WIDE: Final = 120.0
_HIGH: Final = 16.0
_MIDDLE: Final = _HIGH / 2
_INSIDE: Final = "#d7e8df"
_COLOURS: Final = {Outcome.PASS: "#00795a", Outcome.FAIL: "#b34a00"}
_UNDECIDED: Final = "#5a616b"


def drawn_bar(bar: LimitBar) -> Markup:
    """What is between the limits, shaded, and the value with its 95% interval over it; none where it has no value.

    Without colours the mark says the outcome: a disc passes, a cross fails, a ring is not decided; an arrow points to
    a value that lies beyond the end of the bar.
    """
    first, last = (place * _WIDE for place in bar.inside)
    parts = [f'<path d="M{first:g} 2H{last:g}V{_HIGH - 2:g}H{first:g}z" fill="{_INSIDE}"/>']
    parts += [
        f'<path d="M{limit * _WIDE:g} 1V{_HIGH - 1:g}" stroke="#666" stroke-width="1.2"/>'
        for limit in (bar.minimum, bar.maximum)
        if limit is not None
    ]
    if bar.value is not None:
        begin, end = (place * _WIDE for place in bar.interval)
        colour = _COLOURS.get(bar.outcome, _UNDECIDED)
        parts.append(f'<path d="M{begin:.1f} {_MIDDLE:g}H{end:.1f}" stroke="{colour}" stroke-width="2"/>')
        parts.append(_mark(bar, bar.value * _WIDE, colour))
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" class="bar" aria-hidden="true" width="{_WIDE:g}" height="{_HIGH:g}" '
        f'viewBox="0 0 {_WIDE:g} {_HIGH:g}">{"".join(parts)}</svg>'
    )


def _mark(bar: LimitBar, x: float, colour: str) -> str:
    if bar.beyond:
        return f'<path d="M{x + 3 * bar.beyond:.1f} {_MIDDLE:g}l{-7 * bar.beyond} -5v10z" fill="{colour}"/>'
    match bar.outcome:
        case Outcome.PASS:
            return f'<circle cx="{x:.1f}" cy="{_MIDDLE:g}" r="3.4" fill="{colour}"/>'
        case Outcome.FAIL:
            return f'<path d="M{x - 4:.1f} 4l8 8m0 -8l-8 8" stroke="{colour}" stroke-width="2.4" fill="none"/>'
        case _:
            return (
                f'<circle cx="{x:.1f}" cy="{_MIDDLE:g}" r="3.4" fill="#ffffff" stroke="{colour}" stroke-width="1.6"/>'
            )
