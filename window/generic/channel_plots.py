"""What every channel gave, against time, number of the point, or the position of an axis."""

from collections.abc import Mapping, Sequence

import numpy as np
from PySide6.QtWidgets import QComboBox, QFormLayout, QVBoxLayout

from tumble.calibrations.core.arrays import FloatArray
from tumble.procedures.layout import Layout
from tumble.procedures.steps import Point
from tumble.window.look.channels import axis_text, channel_parts
from tumble.window.look.language import tr
from tumble.window.parts import Figures
from tumble.window.widgets.series_plot import SeriesPlot
from tumble.window.work.background import Background

_OVERLOAD = 1e30


class ChannelPlot(SeriesPlot):
    """Channels of one unit, which stands at the ordinate."""

    def title_of(self, name: str) -> str:
        """What a channel gives."""
        return channel_parts(name)[0]


class ChannelPlots(Figures):
    """A plot for each unit in which there are channels."""

    def __init__(self, layout: Layout, _: Background) -> None:
        super().__init__()
        self.points: list[Point] = []
        self.against = QComboBox()
        self.against.addItem(tr("point"), "")
        self.against.addItem(tr("time (min)"), "time")
        for name in layout.positions:
            self.against.addItem(axis_text(name), name)
        self._channels = _by_unit(layout.channels)
        self.plots = {
            unit: ChannelPlot(names, self.against.currentText(), _mean(unit)) for unit, names in self._channels.items()
        }
        choice = QFormLayout()
        choice.addRow(tr("A&gainst"), self.against)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(choice)
        for plot in self.plots.values():
            column.addWidget(plot, stretch=1)
        self.against.currentIndexChanged.connect(self._name_axes)

    def begin(self, points: Sequence[Point]) -> None:
        """Show a run that begins, or goes on after some points."""
        self.points = list(points)
        self.draw_later(self._draw)

    def add(self, point: Point) -> None:
        """Show a further point."""
        self.points.append(point)
        self.draw_later(self._draw)

    def _draw(self) -> None:
        abscissae = np.array([self._abscissa(point) for point in self.points], dtype=float)
        for unit, names in self._channels.items():
            self.plots[unit].draw_series({name: (abscissae, self._means(name)) for name in names})

    def _abscissa(self, point: Point) -> float:
        match self.against.currentData():
            case "":
                return point.index + 1.0
            case "time":
                return point.time_s / 60.0
            case name:
                return point.positions_deg[name]

    def _means(self, channel: str) -> FloatArray:
        readings = [point.readings.get(channel) for point in self.points]
        means = np.array([np.nan if each is None else each.mean for each in readings], dtype=float)
        return np.where(np.abs(means) < _OVERLOAD, means, np.nan)

    def _name_axes(self) -> None:
        for unit, plot in self.plots.items():
            plot.name_axes(self.against.currentText(), _mean(unit))
            plot.forget_key()
            plot.way_back.home()
        self.draw_later(self._draw)


def _mean(unit: str) -> str:
    mean = tr("mean")
    return f"{mean} ({unit})"


def _by_unit(channels: Mapping[str, object]) -> dict[str, list[str]]:
    """Names of channels by their units; by their ends, where nothing is known of these."""
    units: dict[str, list[str]] = {}
    for name in channels:
        units.setdefault(channel_parts(name)[1] or name.rpartition("_")[2], []).append(name)
    return units
