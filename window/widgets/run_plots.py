"""What is drawn of every run, whatever it measures: temperature, and the samples of the last dwell."""

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QWidget

from tumble.calibrations.core.arrays import FloatArray
from tumble.drivers.protocols import Block
from tumble.procedures.steps import Point
from tumble.window.look.language import tr
from tumble.window.look.plots import Plot

_DRAWN_SAMPLES: Final = 2000
"""Of each channel; more than a screen has columns says nothing more."""


class TemperaturePlot(Plot):
    """Temperature against time."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            bottom=tr("time (min)"),
            left=tr("temperature (°C)"),
            parent=parent,
        )
        self._line = self.plot([], [], pen=self.pen(self.colours.accent))
        self.recoloured.connect(lambda: self._line.setPen(self.pen(self.colours.accent)))

    def draw_points(self, points: Sequence[Point]) -> None:
        """Draw the points that have a temperature."""
        told = [(point.time_s / 60.0, point.temperature_degc) for point in points if point.temperature_degc is not None]
        times_min, temperatures_degc = zip(*told, strict=True) if told else ((), ())
        self._line.setData(np.array(times_min, dtype=float), np.array(temperatures_degc, dtype=float))
        self.fit_axes()


class SamplesPlot(Plot):
    """The samples of the last dwell, every channel a line."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            bottom=tr("time in the dwell (s)"),
            left=tr("samples (V)"),
            parent=parent,
        )
        self._lines: list[pg.PlotDataItem] = []
        self.recoloured.connect(self._restyle)

    def draw_block(self, block: Block) -> None:
        """Draw a block, thinned to its extremes where there are more samples than columns."""
        channels = block.channels
        while len(self._lines) < len(channels):
            self._lines.append(self.plot([], []))
            self._restyle()
        for line, (name, voltage_v) in zip(self._lines, channels.items(), strict=False):
            times_s, extremes_v = thinned(np.where(np.abs(voltage_v) < 1e30, voltage_v, np.nan), block.rate_hz)
            line.setData(times_s, extremes_v, connect="finite", name=name)
        self.fit_axes()

    def begin(self, channels: Iterable[str]) -> None:
        """Draw nothing, until there are samples of these channels; the names of those in volts end in `_v`."""
        volts = all(name.endswith("_v") for name in channels)
        self.name_axes(tr("time in the dwell (s)"), tr("samples (V)") if volts else tr("samples"))
        for line in self._lines:
            line.setData([], [])

    def _restyle(self) -> None:
        for number, line in enumerate(self._lines):
            line.setPen(self.pen(self.colours.data[number % len(self.colours.data)], 1))


def thinned(voltage_v: FloatArray, rate_hz: float) -> tuple[FloatArray, FloatArray]:
    """Times and values to draw: all of them, or the lowest and the highest of every stretch."""
    count = len(voltage_v)
    if count <= _DRAWN_SAMPLES:
        return np.arange(count) / rate_hz, voltage_v
    stretch = -(-count * 2 // _DRAWN_SAMPLES)
    whole = count // stretch * stretch
    stretches = voltage_v[:whole].reshape(-1, stretch)
    extremes = np.stack([stretches.min(axis=1), stretches.max(axis=1)], axis=1).ravel()
    return np.repeat(np.arange(len(stretches)) * stretch / rate_hz, 2), extremes
