"""The points of a run as a table: where each was taken, and what every channel gave."""

import math
from collections.abc import Sequence
from typing import Final

from PySide6.QtWidgets import QVBoxLayout

from tumble.calibrations.core.quantities import rounded
from tumble.procedures.layout import Layout
from tumble.procedures.steps import Dwell, Point, Reading
from tumble.window.look.channels import axis_text, channel_text
from tumble.window.look.language import tr
from tumble.window.look.names import in_words, instrument_name
from tumble.window.look.numbers import local
from tumble.window.parts import Overview
from tumble.window.widgets.table import Table

_SHOWN: Final = 200
"""The newest points; a table of all of a long run would be felt."""


class PointTable(Overview):
    """The newest point on top, and above it the dwell that is taken now."""

    def __init__(self, layout: Layout) -> None:
        super().__init__()
        self._names = tuple(layout.conditions), tuple(layout.positions), tuple(layout.channels)
        conditions, positions, channels = self._names
        asked = map(instrument_name, conditions)
        self.table = Table((tr("point"), *asked, *map(axis_text, positions), *map(channel_text, channels)))
        self._rows: list[tuple[str, ...]] = []
        self._now: tuple[str, ...] = ()
        self._done = 0
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table)

    @property
    def done(self) -> int:
        """Number of dwells that are done."""
        return self._done

    def show_plan(self, dwells: Sequence[Dwell], points: Sequence[Point] = ()) -> None:  # noqa: ARG002
        """Show the points so far; those to come are not listed."""
        self._rows, self._now, self._done = [], (), len(points)
        for point in points[-_SHOWN:]:
            self._rows.insert(0, self._row(point))
        self._fill()

    def begin(self, dwell: Dwell) -> None:
        """Show a dwell without values."""
        conditions, positions, channels = self._names
        places = (_angle(dwell.targets_deg[name]) if name in dwell.targets_deg else "" for name in positions)
        asked = (in_words(dwell.conditions.get(name, "")) for name in conditions)
        self._now = (f"▶ {self._done + 1}", *asked, *places, *("" for _ in channels))
        self._fill()

    def complete(self, dwell: Dwell, point: Point) -> None:  # noqa: ARG002  # the point says where
        """Show the point that came of a dwell."""
        self._now, self._done = (), self._done + 1
        self._rows = [self._row(point), *self._rows][:_SHOWN]
        self._fill()

    def _row(self, point: Point) -> tuple[str, ...]:
        conditions, positions, channels = self._names
        places = (_angle(point.positions_deg[name]) for name in positions)
        means = (_mean(point.readings.get(name)) for name in channels)
        asked = (in_words(point.conditions.get(name, "")) for name in conditions)
        return (_number(point), *asked, *places, *means)

    def _fill(self) -> None:
        self.table.fill([row for row in (self._now, *self._rows) if row])


def _number(point: Point) -> str:
    """Of the point, and which take it is where it was taken again."""
    number = str(point.index + 1)
    return number if point.take == 1 else tr("{point}, take {take}", point=number, take=point.take)


def _angle(angle_deg: float) -> str:
    return local(f"{angle_deg:z.4f}")


def _mean(reading: Reading | None) -> str:
    """With as many digits as the scatter of the samples leaves; empty where the stand has no such channel."""
    if reading is None:
        return ""
    return local(rounded(reading.mean, reading.sd / math.sqrt(reading.samples), "").value)
