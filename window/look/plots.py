"""Plots in the colours of the window."""

import math
from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QKeyEvent
from PySide6.QtWidgets import QWidget

from tumble.window.look.numbers import local
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours
from tumble.window.look.way_back import WayBack

_WIDE_LINES, _HIGH_LINES = 11, 7
"""Least size, in lines of text."""
_BAND = 0.16
"""How far a range that is drawn hides the paper, from 0 to 1."""


class LocalAxis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph is not typed
    """Numbers with the decimal sign of the language."""

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:  # noqa: N802  # its name
        """The numbers beside the ticks."""
        return [local(text) for text in super().tickStrings(values, scale, spacing)]

    def tickSpacing(self, minVal: float, maxVal: float, size: float) -> list[tuple[float, float]]:  # noqa: N802, N803
        """Steps between ticks and where they begin, the widest first, which has room for a line of text."""
        steps: list[tuple[float, float]] = super().tickSpacing(minVal, maxVal, size)
        line = QFontMetricsF(self.style["tickFont"] or self.font()).height()
        least = line * (maxVal - minVal) / max(size, 1.0)
        widest = steps[0][0]
        if self.orientation == "bottom" or widest >= least:
            return steps
        return [(widest * math.ceil(least / widest), 0.0), *steps]


class Plot(pg.PlotWidget):  # type: ignore[misc]  # pyqtgraph is not typed
    """Axes with a grid, and a way back after the wheel; told with `recoloured` that the palette has changed."""

    recoloured = Signal()
    _look: tuple[Colours, QFont] | None = None
    """Colours and font that it was drawn in; None while its axes are being made."""

    def __init__(self, bottom: str, left: str, parent: QWidget | None = None) -> None:
        axes = {side: LocalAxis(side) for side in ("left", "bottom")}
        super().__init__(parent, axisItems=axes, enableMenu=False)
        self.hideButtons()
        self.way_back = WayBack(self)
        self.getPlotItem().setContentsMargins(0, 4, 8, 0)
        self.name_axes(bottom, left)
        self.setAccessibleName(f"{left}, {bottom}")
        self._recolour()

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """Small: plots share what room there is."""
        return QSize(300, 140)

    @property
    def colours(self) -> Colours:
        """What to draw with."""
        return colours(self)

    def name_axes(self, bottom: str, left: str) -> None:
        """Say what is drawn against what: the ordinate above the plot, where it is read without turning the head."""
        self._left = left
        for side in ("bottom", "left"):
            self.getAxis(side).enableAutoSIPrefix(False)
        self.getAxis("bottom").setLabel(bottom)
        self.entitle()

    def use_bottom_axis(self, axis: pg.AxisItem) -> None:
        """Draw against another kind of axis."""
        if self.getAxis("bottom") is not axis:
            self.setAxisItems({"bottom": axis})
            self._recolour()

    def pen(self, colour: str, width: float = 1.5, **style: Any) -> Any:  # noqa: ANN401  # a QPen
        """A pen that is as wide at every magnification."""
        return pg.mkPen(colour, width=width, **style)

    @property
    def band(self) -> QColor:
        """For a range that marks and lines are drawn over."""
        tint = QColor(self.colours.accent)
        tint.setAlphaF(_BAND)
        return tint

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Home shows the whole picture, Backspace what was seen before the last change."""
        match event.key():
            case Qt.Key.Key_Home:
                self.way_back.home()
            case Qt.Key.Key_Backspace:
                self.way_back.back()
            case _:
                super().keyPressEvent(event)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette."""
        super().changeEvent(event)
        if self._look is None or event.type() not in (QEvent.Type.PaletteChange, QEvent.Type.FontChange):
            return
        if self._look != (colours(self), self.font()):
            self._recolour()
            self.recoloured.emit()

    def _recolour(self) -> None:
        self._look = colours(self), self.font()
        chosen, line = colours(self), self.fontMetrics().height()
        self.setMinimumSize(_WIDE_LINES * line, _HIGH_LINES * line)
        self.setBackground(chosen.paper)
        for side in ("bottom", "left"):
            axis = self.getAxis(side)
            axis.setPen(chosen.pale)
            axis.setTextPen(chosen.ink)
            axis.setTickFont(self.font())
            axis.label.setFont(self.font())
        self.entitle()
        self.showGrid(x=True, y=True, alpha=0.18)

    def entitle(self, key: str = "") -> None:
        """Put a title above the plot: the ordinate, and a `key` to what is drawn, which so never hides it."""
        size = f"{self.font().pointSizeF():g}pt"
        self.getPlotItem().setTitle(self._left + key, color=colours(self).ink, size=size, justify="left")
