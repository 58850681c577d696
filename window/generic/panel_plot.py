"""A panel of a described figure as a plot of the window: it can be zoomed, read, copied and saved as every other."""

from collections.abc import Iterator
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QWidget

from tumble.calibrations.report.layers import BAND, COLOURS, INK, PALE, Area, Axis, Line, Marks, Panel, Sheet, Span
from tumble.window.look.plots import Plot
from tumble.window.look.sentences import in_language
from tumble.window.widgets.series_plot import SIGNS

_SYMBOLS: Final = {
    "circle": "o",
    "square": "s",
    "triangle": "t1",
    "diamond": "d",
    "down": "t",
    "cross": "x",
    "dot": "o",
}
_SIZE: Final = 0.31
"""Width of what has a point on the page, of that of a mark."""
_LEAST_PX: Final = 4.0


def plottable(sheet: Sheet) -> bool:
    """Whether a figure is made of what a plot can draw: boxes, matrices and powers of ten are pictures."""
    layers = [layer for panel in sheet.panels for layer in panel.layers]
    linear = not any(axis.logarithmic for panel in sheet.panels for axis in (panel.x, panel.y))
    return linear and all(isinstance(layer, Marks | Line | Area | Span) for layer in layers)


class PanelPlot(Plot):
    """Draws the layers of a panel in the colours of the window.

    `bottom` and `left` name the axes where the panel leaves that to a neighbour.
    """

    def __init__(self, panel: Panel, bottom: str = "", left: str = "", parent: QWidget | None = None) -> None:
        across, up = in_language(panel.x.label or bottom), in_language(panel.y.label or left)
        super().__init__(bottom=across, left=up, parent=parent)
        self._panel = panel
        self._title = in_language(panel.title)
        self.getViewBox().setAspectLocked(panel.equal_units)
        self._draw()
        self.recoloured.connect(self._draw)

    def _draw(self) -> None:
        self.clear()
        for layer in self._panel.layers:
            match layer:
                case Marks():
                    self._draw_marks(layer)
                case Line():
                    self._draw_line(layer)
                case Area():
                    self._draw_area(layer)
                case Span():
                    self._draw_span(layer)
        for axis, side in ((self._panel.x, "bottom"), (self._panel.y, "left")):
            self._dress(axis, side)
        self.entitle("".join([f" &nbsp; {self._title}" if self._title else "", *self._key()]))

    def _draw_marks(self, layer: Marks) -> None:
        colour = self._colour(layer.colour)
        for ends, sides in ((layer.y_ends, ("bottom", "top")), (layer.x_ends, ("left", "right"))):
            if ends is not None:
                middle = layer.y if sides[1] == "top" else layer.x
                reach = {sides[0]: middle - ends[0], sides[1]: ends[1] - middle}
                self.addItem(pg.ErrorBarItem(x=layer.x, y=layer.y, **reach, beam=0, pen=self.pen(colour, layer.bar)))
        self.plot(
            layer.x,
            layer.y,
            name=in_language(layer.label),
            pen=None,
            symbol=_SYMBOLS[layer.shape],
            symbolSize=max(_SIZE * self.mark_px * layer.size, _LEAST_PX),
            symbolBrush=None if layer.hollow else pg.mkBrush(colour),
            symbolPen=pg.mkPen(colour) if layer.hollow or layer.shape == "cross" else pg.mkPen(None),
        )

    def _draw_line(self, layer: Line) -> None:
        style = Qt.PenStyle.DashLine if layer.dashed else Qt.PenStyle.SolidLine
        pen = self.pen(self._colour(layer.colour), layer.width, style=style)
        self.plot(layer.x, layer.y, name=in_language(layer.label), pen=pen, connect="finite")

    def _draw_area(self, layer: Area) -> None:
        edges = [pg.PlotCurveItem(layer.x, edge, pen=pg.mkPen(None)) for edge in (layer.low, layer.high)]
        self.addItem(pg.FillBetweenItem(*edges, brush=self._transparent(layer.colour, layer.opacity)))

    def _draw_span(self, layer: Span) -> None:
        if layer.low == layer.high:
            pen = self.pen(self._colour(layer.colour), 1)
            self.addItem(pg.InfiniteLine(layer.low, angle=0, pen=pen), ignoreBounds=True)
            return
        brush = self._transparent(layer.colour, layer.opacity)
        band = pg.LinearRegionItem((layer.low, layer.high), orientation="horizontal", movable=False, brush=brush)
        band.setZValue(-10)
        for edge in band.lines:
            edge.setPen(pg.mkPen(None))
        self.addItem(band)

    def _dress(self, axis: Axis, side: str) -> None:
        """Numbers and ends of an axis, where they are given."""
        if len(axis.ticks):
            names = [in_language(each) for each in axis.names] or [f"{tick:g}" for tick in axis.ticks]
            self.getAxis(side).setTicks([list(zip(axis.ticks, names, strict=True))])
        if axis.ends is not None:
            show = self.setXRange if side == "bottom" else self.setYRange
            show(*sorted(axis.ends), padding=0)

    def _key(self) -> Iterator[str]:
        """Sign and name of every layer that has a label."""
        for layer in self._panel.layers:
            if isinstance(layer, Marks | Line) and layer.label:
                sign = "—" if isinstance(layer, Line) else SIGNS.get(_SYMBOLS[layer.shape], "×")
                mark = f'<span style="color: {self._colour(layer.colour)}">{sign}</span>'
                yield f" &nbsp; {mark} {in_language(layer.label)}"

    def _colour(self, of_page: str) -> str:
        """A colour of the page as the window has it."""
        ours = dict(zip(COLOURS, self.colours.data, strict=True))
        return {**ours, INK: self.colours.ink, PALE: self.colours.pale}.get(of_page, of_page)

    def _transparent(self, of_page: str, opacity: float) -> QColor:
        if of_page == BAND:
            return self.band  # marks stand out from it in every colour of the window
        tint = QColor(self._colour(of_page))
        tint.setAlphaF(opacity)
        return tint


def panel_plots(sheet: Sheet) -> list[PanelPlot]:
    """The panels of a figure as plots; what only one of them says of its axes is said by all."""
    bottom = next((panel.x.label for panel in reversed(sheet.panels) if panel.x.label), "")
    left = next((panel.y.label for panel in sheet.panels if panel.y.label), "")
    return [PanelPlot(panel, bottom, left) for panel in sheet.panels]
