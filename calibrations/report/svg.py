"""A described figure as SVG: vectors for page, paper and window, the same bytes for the same figure.

Texts are texts, in the language of the page that is written. The script of the page (`figures.js`) finds in `data-x`
and `data-y` where the axes of a panel begin and end.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import Final

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.report.extent import Ends, extent, tick_texts, ticks
from tumble.calibrations.report.language import say
from tumble.calibrations.report.layers import Axis, Line, Marks, Panel, Sheet
from tumble.calibrations.report.marks import Place, marked, sample, shade

_SIZE: Final = 11
"""Of letters."""
_LETTER: Final = 6.0
_BOLD: Final = 7.4
"""So wide one is at most, on the whole."""
_ROOM: Final = 5
"""Letters that a number beside the axis has room for, at least: a part of it has more digits than the whole."""
_LINE: Final = 15.0
_TICKS_APART: Final = 60.0
_RULE: Final = "#e4e6ea"
_FRAME: Final = "#666"
_INK: Final = "#222222"
_SCALE_WIDTH: Final = 74.0
_PAGE: Final = 720.0
_PAGE_MM: Final = 174.0
"""Width of what stands on a page, in units and on paper."""


def drawn(figure: Sheet) -> Markup:
    """The figure as an SVG element for a page that has others."""
    rows = -(-len(figure.panels) // figure.columns)
    legend = list(_legend(figure))
    top = _LINE * max((entry.row + 1 for entry in legend), default=0)
    wide = (figure.width - (_SCALE_WIDTH if figure.scale else 0.0)) / figure.columns
    parts = [entry.svg for entry in legend]
    for number, panel in enumerate(figure.panels):
        row, column = divmod(number, figure.columns)
        parts.append(_Frame(panel, column * wide, top + row * figure.height, wide, figure.height).svg)
    if figure.scale:
        parts.append(_scale(*figure.scale, figure.width - _SCALE_WIDTH, top + 20.0, figure.height - 60.0))
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" class="figure" id="figure-{escape(figure.name)}" role="img" '
        f'aria-label="{escape(say(figure.description))}" viewBox="0 0 {figure.width:g} {top + rows * figure.height:g}" '
        f'width="{figure.width / _PAGE * _PAGE_MM:.1f}mm" style="max-width:{100 * figure.width / _PAGE:.3g}%" '
        f'font-family="sans-serif" font-size="{_SIZE}" fill="{_INK}">{"".join(parts)}</svg>'
    )


@dataclass(frozen=True)
class _Frame:
    """A panel with its labels, in a rectangle of the figure."""

    panel: Panel
    left: float
    top: float
    wide: float
    high: float

    @cached_property
    def ends(self) -> tuple[Ends, Ends]:
        return extent(self.panel)

    @cached_property
    def y_ticks(self) -> list[tuple[float, str]]:
        places = ticks(self.panel.y, self.ends[1], max(2, int(self.high / 40.0)))
        return [(place, say(text)) for place, text in zip(places, tick_texts(self.panel.y, places), strict=True)]

    @cached_property
    def x_ticks(self) -> list[tuple[float, str]]:
        places = ticks(self.panel.x, self.ends[0], max(2, int(self.width / _TICKS_APART)))
        return [(place, say(text)) for place, text in zip(places, tick_texts(self.panel.x, places), strict=True)]

    @cached_property
    def before(self) -> float:
        """Left of the axes: label and numbers."""
        widest = max(_ROOM, *(len(text) for _, text in self.y_ticks))
        return _LETTER * widest + 10.0 + (_LINE if self.panel.y.label else 0.0)

    @cached_property
    def above(self) -> float:
        return _LINE + 4.0 if self.panel.title else 8.0

    @cached_property
    def width(self) -> float:
        return self.wide - self.before - 14.0

    @cached_property
    def height(self) -> float:
        return self.high - self.above - _LINE - 5.0 - (_LINE if self.panel.x.label else 0.0)

    @property
    def svg(self) -> str:
        x, y = (
            _placed(self.panel.x, self.ends[0], 0.0, self.width),
            _placed(self.panel.y, self.ends[1], self.height, 0.0),
        )
        layers = "".join(marked(layer, x, y, self.width) for layer in self.panel.layers)
        return (
            f'<g class="panel" transform="translate({self.left + self.before:.1f} {self.top + self.above:.1f})" '
            f'data-size="{self.width:.1f} {self.height:.1f}" data-x="{_data(self.panel.x, self.ends[0])}" '
            f'data-y="{_data(self.panel.y, self.ends[1])}">'
            f'<g class="rules">{"".join(self._rules(x, y))}</g><g class="plot">{layers}</g>'
            f'<path d="M0 0V{self.height:.1f}H{self.width:.1f}" fill="none" stroke="{_FRAME}" stroke-width="0.8"/>'
            f'<g class="numbers">{"".join(self._numbers(x, y))}</g>{"".join(self._labels())}</g>'
        )

    def _rules(self, x: Place, y: Place) -> Iterator[str]:
        across = "".join(f"M{at:.1f} 0V{self.height:.1f}" for at in x(_places(self.x_ticks)))
        along = "".join(f"M0 {at:.1f}H{self.width:.1f}" for at in y(_places(self.y_ticks)))
        yield f'<path d="{across}{along}" fill="none" stroke="{_RULE}" stroke-width="0.8"/>'

    def _numbers(self, x: Place, y: Place) -> Iterator[str]:
        for at, (_, text) in zip(x(_places(self.x_ticks)), self.x_ticks, strict=True):
            yield _text(at, self.height + _SIZE + 3.0, text, "middle")
        for at, (_, text) in zip(y(_places(self.y_ticks)), self.y_ticks, strict=True):
            yield _text(-5.0, at + 4.0, text, "end")

    def _labels(self) -> Iterator[str]:
        if self.panel.title:
            title = say(self.panel.title)
            yield _text(0.0, -7.0, title, "start", f' font-weight="bold"{_to_fit(title, self.width, _BOLD)}')
        if self.panel.x.label:
            label = say(self.panel.x.label)
            yield _text(self.width / 2, self.height + 2 * _LINE, label, "middle", _to_fit(label, self.width))
        if self.panel.y.label:
            label = say(self.panel.y.label)
            more = f' transform="rotate(-90)"{_to_fit(label, self.height + 10.0)}'
            yield _text(-self.height / 2, -self.before + _SIZE + 1.0, label, "middle", more)


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
        wide = 24.0 + _LETTER * len(text) + 14.0
        if x + wide > figure.width and x > 6.0:
            x, row = 6.0, row + 1
        y = row * _LINE + 7.0
        yield _Entry(row, sample(layer, x, y) + _text(x + 23.0, y + 4.0, text, "start"))
        x += wide


def _placed(axis: Axis, ends: Ends, first: float, last: float) -> Place:
    """From numbers to units of the page."""
    low, high = np.log10(ends) if axis.logarithmic else ends

    def place(values: FloatArray) -> FloatArray:
        numbers = np.asarray(values, dtype=float)
        if axis.logarithmic:
            numbers = np.log10(np.where(numbers > 0.0, numbers, np.nan))
        return np.asarray(first + (numbers - low) / (high - low) * (last - first))

    return place


def _data(axis: Axis, ends: Ends) -> str:
    """What the script is told of an axis; one with names of its own keeps them."""
    kind = "names" if axis.names else "log" if axis.logarithmic else "linear"
    return f"{ends[0]!r} {ends[1]!r} {kind}"


def _places(marks: list[tuple[float, str]]) -> FloatArray:
    return np.array([place for place, _ in marks])


def _scale(label: str, most: float, left: float, top: float, high: float) -> str:
    """Colours from the largest number down to its opposite, with their numbers."""
    steps = 24
    bars = [
        f'<path d="M{left + 8:g} {top + high * number / steps:.2f}h12v{high / steps + 0.3:.2f}h-12z" '
        f'fill="{shade(1.0 - 2.0 * (number + 0.5) / steps)}"/>'
        for number in range(steps)
    ]
    numbers = [
        _text(left + 25.0, top + high * (1.0 - part) / 2.0 + 4.0, say(f"{part * most:.3g}"), "start")
        for part in (1.0, 0.0, -1.0)
    ]
    turned = ' transform="rotate(-90)"'
    return "".join([*bars, *numbers, _text(-top - high / 2, left + _SCALE_WIDTH - 6.0, say(label), "middle", turned)])


def _to_fit(text: str, room: float, letter: float = _LETTER) -> str:
    """The size of letters in which a text is no longer than the room that it has; nothing where it is short enough."""
    size = _SIZE * min(1.0, room / (letter * max(len(text), 1)))
    return "" if size == _SIZE else f' font-size="{size:.1f}"'


def _text(x: float, y: float, text: str, anchor: str, more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(text)}</text>'
