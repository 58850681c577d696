"""A described figure as SVG: vectors for page, paper and window, the same bytes for the same figure.

Texts are texts, in the language of the page that is written. The script of the page (`figures.js`) finds in `data-x`
and `data-y` where the axes of a panel begin and end.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from html import escape
from typing import Final

from markupsafe import Markup

from tumble.calibrations.report.frame import Frame
from tumble.calibrations.report.language import say
from tumble.calibrations.report.layers import Line, Marks, Sheet
from tumble.calibrations.report.lettering import LETTER, LINE, SIZE, text_at
from tumble.calibrations.report.marks import sample, shade

_INK: Final = "#222222"
_SCALE_WIDTH: Final = 74.0
_PAGE: Final = 720.0
_PAGE_MM: Final = 174.0
"""Width of what stands on a page, in units and on paper."""


def drawn(figure: Sheet) -> Markup:
    """The figure as an SVG element for a page that has others."""
    rows = -(-len(figure.panels) // figure.columns)
    legend = list(_legend(figure))
    top = LINE * max((entry.row + 1 for entry in legend), default=0)
    wide = (figure.width - (_SCALE_WIDTH if figure.scale else 0.0)) / figure.columns
    parts = [entry.svg for entry in legend]
    frames = [
        Frame(panel, column * wide, top + row * figure.height, wide, figure.height)
        for number, panel in enumerate(figure.panels)
        for row, column in (divmod(number, figure.columns),)
    ]
    lines = 2 if any(frame.title_is_long for frame in frames) else 1
    parts += [replace(frame, title_lines=lines).svg for frame in frames]
    if figure.scale:
        parts.append(_scale(*figure.scale, figure.width - _SCALE_WIDTH, top + 20.0, figure.height - 60.0))
    high = top + rows * figure.height
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" class="figure" id="figure-{escape(figure.name)}" role="img" '
        f'aria-label="{escape(say(figure.description))}" viewBox="0 0 {figure.width:g} {high:g}" '
        f'width="{figure.width / _PAGE * _PAGE_MM:.1f}mm" height="{high / _PAGE * _PAGE_MM:.1f}mm" '
        f'style="max-width:{100 * figure.width / _PAGE:.3g}%;height:auto" '
        f'font-family="sans-serif" font-size="{SIZE}" fill="{_INK}">{"".join(parts)}</svg>'
    )


@dataclass(frozen=True)
class _Entry:
    row: int
    svg: str


def _legend(figure: Sheet) -> Iterator[_Entry]:
    """What the labels of all panels mean, above them, each once."""
    labelled: dict[str, Marks | Line] = {}
    for panel in figure.panels:
        for layer in panel.layers:
            if isinstance(layer, Marks | Line) and layer.label:
                labelled.setdefault(say(layer.label), layer)
    x, row = 6.0, 0
    for text, layer in labelled.items():
        wide = 24.0 + LETTER * len(text) + 14.0
        if x + wide > figure.width and x > 6.0:
            x, row = 6.0, row + 1
        y = row * LINE + 7.0
        yield _Entry(row, sample(layer, x, y) + text_at(x + 23.0, y + 4.0, text, "start"))
        x += wide


def _scale(label: str, most: float, left: float, top: float, high: float) -> str:
    """Colours from the largest number down to its opposite, with their numbers."""
    steps = 24
    bars = [
        f'<path d="M{left + 8:g} {top + high * number / steps:.2f}h12v{high / steps + 0.3:.2f}h-12z" '
        f'fill="{shade(1.0 - 2.0 * (number + 0.5) / steps)}"/>'
        for number in range(steps)
    ]
    numbers = [
        text_at(left + 25.0, top + high * (1.0 - part) / 2.0 + 4.0, say(f"{part * most:.3g}"), "start")
        for part in (1.0, 0.0, -1.0)
    ]
    turned = ' transform="rotate(-90)"'
    return "".join([*bars, *numbers, text_at(-top - high / 2, left + _SCALE_WIDTH - 6.0, say(label), "middle", turned)])
