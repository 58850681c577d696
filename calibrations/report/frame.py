"""A panel of a figure: its axes with their numbers and labels, and what is drawn between them."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.report.extent import Ends, extent, tick_texts, ticks
from tumble.calibrations.report.language import say
from tumble.calibrations.report.layers import Axis, Panel
from tumble.calibrations.report.lettering import BOLD, LETTER, LINE, SIZE, in_lines, text_at, to_fit
from tumble.calibrations.report.marks import Place, marked

_ROOM: Final = 5
"""Letters that a number beside the axis has room for, at least: a part of it has more digits than the whole."""
_TICKS_APART: Final = 60.0
_RULE: Final = "#e4e6ea"
_FRAME: Final = "#666"


@dataclass(frozen=True)
class Frame:
    """A panel with its labels, in a rectangle of the figure."""

    panel: Panel
    left: float
    top: float
    wide: float
    high: float
    title_lines: int = 1
    """So many it has room for; two keep long titles readable."""

    @cached_property
    def ends(self) -> tuple[Ends, Ends]:
        """Of both axes."""
        return extent(self.panel)

    @cached_property
    def y_ticks(self) -> list[tuple[float, str]]:
        """Places and texts of the numbers beside the panel."""
        places = ticks(self.panel.y, self.ends[1], max(2, int(self.high / 40.0)))
        return [(place, say(text)) for place, text in zip(places, tick_texts(self.panel.y, places), strict=True)]

    @cached_property
    def x_ticks(self) -> list[tuple[float, str]]:
        """The same below it."""
        places = ticks(self.panel.x, self.ends[0], max(2, int(self.width / _TICKS_APART)))
        return [(place, say(text)) for place, text in zip(places, tick_texts(self.panel.x, places), strict=True)]

    @cached_property
    def before(self) -> float:
        """Left of the axes: label and numbers."""
        widest = max(_ROOM, *(len(text) for _, text in self.y_ticks))
        return LETTER * widest + 10.0 + (LINE if self.panel.y.label else 0.0)

    @cached_property
    def above(self) -> float:
        """Above the axes: the title."""
        return LINE * self.title_lines + 4.0 if self.panel.title else 8.0

    @property
    def title_is_long(self) -> bool:
        """Whether the title has to be set smaller to stand in one line."""
        return bool(to_fit(say(self.panel.title), self.width, BOLD))

    @cached_property
    def width(self) -> float:
        """Between the axes."""
        return self.wide - self.before - 14.0

    @cached_property
    def height(self) -> float:
        """The same upwards."""
        return self.high - self.above - LINE - 5.0 - (LINE if self.panel.x.label else 0.0)

    @property
    def svg(self) -> str:
        """The panel as a group of elements."""
        x, y = (
            _placed(self.panel.x, self.ends[0], 0.0, self.width),
            _placed(self.panel.y, self.ends[1], self.height, 0.0),
        )
        layers = "".join(marked(layer, x, y, self.width) for layer in self.panel.layers)
        return (
            f'<g class="panel" transform="translate({self.left + self.before:.1f} {self.top + self.above:.1f})" '
            f'data-size="{self.width:.1f} {self.height:.1f}" data-x="{_data(self.panel.x, self.ends[0])}" '
            f'data-y="{_data(self.panel.y, self.ends[1])}">'
            f'{self._rules(x, y)}<g class="plot">{layers}</g>'
            f'<path d="M0 0V{self.height:.1f}H{self.width:.1f}" fill="none" stroke="{_FRAME}" stroke-width="0.8"/>'
            f"{self._numbers(x, y)}{''.join(self._labels())}</g>"
        )

    def _rules(self, x: Place, y: Place) -> str:
        across = "".join(f"M{at:.1f} 0V{self.height:.1f}" for at in x(_places(self.x_ticks)))
        along = "".join(f"M0 {at:.1f}H{self.width:.1f}" for at in y(_places(self.y_ticks)))
        return "".join(
            f'<path class="rules {axis}" d="{path}" fill="none" stroke="{_RULE}" stroke-width="0.8"/>'
            for axis, path in (("x", across), ("y", along))
        )

    def _numbers(self, x: Place, y: Place) -> str:
        below = "".join(
            text_at(at, self.height + SIZE + 3.0, text, "middle")
            for at, (_, text) in zip(x(_places(self.x_ticks)), self.x_ticks, strict=True)
        )
        beside = "".join(
            text_at(-5.0, at + 4.0, text, "end")
            for at, (_, text) in zip(y(_places(self.y_ticks)), self.y_ticks, strict=True)
        )
        return f'<g class="numbers x">{below}</g><g class="numbers y">{beside}</g>'

    def _labels(self) -> Iterator[str]:
        if self.panel.title:
            lines = in_lines(say(self.panel.title), self.title_lines if self.title_is_long else 1)
            smaller = to_fit(max(lines, key=len), self.width, BOLD)
            for number, line in enumerate(reversed(lines)):
                yield text_at(0.0, -7.0 - number * LINE, line, "start", f' font-weight="bold"{smaller}')
        if self.panel.x.label:
            label = say(self.panel.x.label)
            yield text_at(self.width / 2, self.height + 2 * LINE, label, "middle", to_fit(label, self.width))
        if self.panel.y.label:
            label = say(self.panel.y.label)
            more = f' transform="rotate(-90)"{to_fit(label, self.height + 10.0)}'
            yield text_at(-self.height / 2, -self.before + SIZE + 1.0, label, "middle", more)


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
