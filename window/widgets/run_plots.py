"""What a run measures, while it does: output and residual against angle, temperature, and the samples of a dwell."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QWidget

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.drivers.protocols import Block
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.window.look.language import tr
from tumble.window.look.plots import Plot
from tumble.window.look.theme import MARKERS
from tumble.window.work.live_fit import LiveFit

_MOUNTS: Final = tuple(MOUNTS)
_SIGNS: Final = {"o": "●", "s": "■", "t1": "▲", "d": "◆", "t": "▼", "p": "⬟"}
"""The shapes of pyqtgraph in writing."""
_DRAWN_SAMPLES: Final = 2000
"""Of each channel; more than a screen has columns says nothing more."""
_MICRO: Final = 1e6


def mount_style(mount: str, shades: Sequence[str]) -> tuple[str, str]:
    """Colour and shape of a mount, the same wherever it is drawn."""
    number = _MOUNTS.index(mount)
    return shades[number % len(shades)], MARKERS[number % len(MARKERS)]


class AnglePlot(Plot):
    """Something of every point against the head angle, in the colour and shape of its mount."""

    def __init__(self, left: str, parent: QWidget | None = None) -> None:
        super().__init__(bottom=tr("head angle (°)"), left=left, parent=parent)
        self._series: dict[str, pg.PlotDataItem] = {}
        self._named: tuple[str, ...] = ()
        self.recoloured.connect(self._restyle)

    def draw_points(self, points: Sequence[Row], values: FloatArray) -> None:
        """Draw a value of every point."""
        self.draw([point.mount for point in points], np.array([point.angle_deg for point in points]), values)

    def draw(self, mounts: Sequence[str], abscissa: FloatArray, values: FloatArray) -> None:
        """Draw a value of every row against another."""
        of = np.array(mounts)
        for mount in dict.fromkeys(mounts):
            at = of == mount
            self._of(mount).setData(abscissa[at], values[at])
        for mount in set(self._series) - set(mounts):
            self.removeItem(self._series.pop(mount))
        if self._named != (named := tuple(self._series)):
            self._named = named
            self._entitle(self._key())

    def _of(self, mount: str) -> pg.PlotDataItem:
        if mount not in self._series:
            self._series[mount] = self.plot([], [], name=mount, **self._style(mount))
        return self._series[mount]

    def forget_key(self) -> None:
        """Write the key anew with the next rows: the axes have other names."""
        self._named = ()

    def _key(self) -> str:
        """Shape and name of every mount, in its colour."""
        styles = {mount: mount_style(mount, self.colours.data) for mount in self._series}
        marks = [f'<span style="color: {colour}">{_SIGNS[shape]}</span> {m}' for m, (colour, shape) in styles.items()]
        return "".join(f" &nbsp; {mark}" for mark in marks)

    def _style(self, mount: str) -> dict[str, object]:
        colour, shape = mount_style(mount, self.colours.data)
        return {"pen": None, "symbol": shape, "symbolSize": 7, "symbolBrush": colour, "symbolPen": None}

    def _restyle(self) -> None:
        for mount, series in self._series.items():
            series.setSymbolBrush(mount_style(mount, self.colours.data)[0])
        self._entitle(self._key())


class OutputPlot(AnglePlot):
    """Output against angle, with the model through every mount."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(left=tr("output (V)"), parent=parent)
        self._curves: dict[str, pg.PlotDataItem] = {}
        self.recoloured.connect(self._recolour_curves)

    def draw_curves(self, curves: Mapping[str, tuple[FloatArray, FloatArray]]) -> None:
        """Draw head angle and model output by mount."""
        for mount in set(self._curves) - set(curves):
            self.removeItem(self._curves.pop(mount))
        for mount, curve in curves.items():
            if mount not in self._curves:
                self._curves[mount] = self.plot([], [])
                self._curves[mount].setZValue(-1)
                self._recolour_curves()
            self._curves[mount].setData(*curve)

    def _recolour_curves(self) -> None:
        for curve in self._curves.values():
            curve.setPen(self.pen(self.colours.pale, 1.2))


class ResidualPlot(AnglePlot):
    """Residual against angle: what is far outside of the band is a gross error, and is ringed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(left=tr("residual (µV)"), parent=parent)
        self._band = pg.LinearRegionItem((0, 0), orientation="horizontal", movable=False)
        self._rings = pg.ScatterPlotItem(size=17, brush=None)
        self._band.setZValue(-10)
        self.addItem(self._band)
        self.addItem(self._rings)
        self._recolour_marks()
        self.recoloured.connect(self._recolour_marks)

    @property
    def ringed(self) -> int:
        """How many gross errors are shown."""
        return len(self._rings.data)

    def draw_fit(self, points: Sequence[Row], fit: LiveFit | None) -> None:
        """Draw the residuals of the points that were fitted."""
        if fit is None:
            self.draw_points((), np.empty(0))
            self._rings.clear()
            return
        residual_uv, fitted = fit.residual_v * _MICRO, points[: fit.points]
        self.draw_points(fitted, residual_uv)
        scatter_uv = fit.scatter_v * _MICRO
        self._band.setRegion((-2 * scatter_uv, 2 * scatter_uv))
        self._rings.setData([fitted[index].angle_deg for index in fit.gross], residual_uv[list(fit.gross)])

    def _recolour_marks(self) -> None:
        tint = pg.mkColor(self.colours.accent)
        tint.setAlpha(40)
        self._band.setBrush(tint)
        for line in self._band.lines:
            line.setPen(self.pen(self.colours.grid, 1))
        self._rings.setPen(self.pen(self.colours.bad, 2.5))


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

    def draw_points(self, points: Sequence[Row]) -> None:
        """Draw the points that have a temperature."""
        told = [(point.time_s / 60.0, point.temperature_degc) for point in points if point.temperature_degc is not None]
        times_min, temperatures_degc = zip(*told, strict=True) if told else ((), ())
        self._line.setData(np.array(times_min, dtype=float), np.array(temperatures_degc, dtype=float))


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
        channels = list(block.channels.values())
        while len(self._lines) < len(channels):
            self._lines.append(self.plot([], []))
            self._restyle()
        for line, voltage_v in zip(self._lines, channels, strict=False):
            times_s, extremes_v = thinned(np.where(np.abs(voltage_v) < 1e30, voltage_v, np.nan), block.rate_hz)
            line.setData(times_s, extremes_v, connect="finite")

    def forget(self) -> None:
        """Draw nothing."""
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
