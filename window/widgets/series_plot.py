"""Points of several series in one plot, each in its own colour and shape, with a key above."""

from collections.abc import Mapping, Sequence
from typing import Final

import pyqtgraph as pg
from PySide6.QtWidgets import QWidget

from tumble.calibrations.core.arrays import FloatArray
from tumble.window.look.plots import Plot
from tumble.window.look.shades import MARKERS

SIGNS: Final = {"o": "●", "s": "■", "t1": "▲", "d": "◆", "t": "▼", "p": "⬟"}
"""The shapes of pyqtgraph in writing, by their names, in the order in which series have them."""


class SeriesPlot(Plot):
    """Values against others, by the name of their series; a series looks the same in every plot of the same names."""

    def __init__(self, names: Sequence[str], bottom: str, left: str, parent: QWidget | None = None) -> None:
        super().__init__(bottom=bottom, left=left, parent=parent)
        self._places = {name: place for place, name in enumerate(names)}
        self._series: dict[str, pg.PlotDataItem] = {}
        self._named: tuple[str, ...] = ()
        self.recoloured.connect(self._restyle)

    def draw_series(self, series: Mapping[str, tuple[FloatArray, FloatArray]]) -> None:
        """Draw abscissae and values by series, in place of what was drawn."""
        for name, (abscissae, values) in series.items():
            self._of(name).setData(abscissae, values)
        for name in set(self._series) - set(series):
            self.removeItem(self._series.pop(name))
        if self._named != (named := tuple(self._series)):
            self._named = named
            self.entitle(self._key())

    def forget_key(self) -> None:
        """Write the key anew with the next series: the axes have other names."""
        self._named = ()

    def title_of(self, name: str) -> str:
        """A series as an operator reads it."""
        return name

    def drawn(self, name: str) -> int:
        """How many points of a series are drawn."""
        places = self._series[name].getData()[0] if name in self._series else None
        return 0 if places is None else len(places)  # None until there is a first point

    def _of(self, name: str) -> pg.PlotDataItem:
        if name not in self._series:
            colour, shape = self._style(name)
            filled, outline = pg.mkBrush(colour), pg.mkPen(None)  # of other kinds, a symbol is kept for every redraw
            style = {
                "pen": None,
                "symbol": shape,
                "symbolSize": self.mark_px,
                "symbolBrush": filled,
                "symbolPen": outline,
            }
            self._series[name] = self.plot([], [], name=self.title_of(name), **style)
        return self._series[name]

    def _style(self, name: str) -> tuple[str, str]:
        """Colour and shape."""
        place, shades = self._places[name], self.colours.data
        return shades[place % len(shades)], MARKERS[place % len(MARKERS)]

    def _key(self) -> str:
        """Shape and name of every series, in its colour."""
        styles = {name: self._style(name) for name in self._series}
        marks = [
            f'<span style="color: {colour}">{SIGNS[shape]}</span> {self.title_of(name)}'
            for name, (colour, shape) in styles.items()
        ]
        return "".join(f" &nbsp; {mark}" for mark in marks)

    def _restyle(self) -> None:
        for name, series in self._series.items():
            series.setSymbolBrush(pg.mkBrush(self._style(name)[0]))
            series.setSymbolSize(self.mark_px)
        self.entitle(self._key())
