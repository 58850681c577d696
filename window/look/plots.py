"""Plots in the colours of the window."""

import math
import re
from collections.abc import Iterable
from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QEnterEvent,
    QFocusEvent,
    QFont,
    QFontMetricsF,
    QGuiApplication,
    QKeyEvent,
    QKeySequence,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from tumble.numerals import localised
from tumble.window.look.language import spoken, tr
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours
from tumble.window.look.way_back import WayBack
from tumble.window.plots.crosshair import Crosshair
from tumble.window.plots.menu import Deed, PlotMenu
from tumble.window.plots.savable import Savable, ask_to_save
from tumble.window.plots.title import Title
from tumble.window.plots.values import Series, Values, items_of, without_unit

_WIDE_LINES, _HIGH_LINES = 11, 7
"""Least size, in lines of text."""
_MARK_LINES = 0.42
"""Width of a mark of a point."""
_GAP_PX = 4
"""Between the numbers of an axis and what it is called, and around them."""
_BAND = 0.16
"""How far a range that is drawn hides the paper, from 0 to 1."""


class LocalAxis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph is not typed
    """Numbers with the decimal sign of the language."""

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:  # noqa: N802  # its name
        """The numbers beside the ticks."""
        language = spoken()  # asked once: it takes longer than all the rest
        return [localised(text, language) for text in super().tickStrings(values, scale, spacing)]

    def tickSpacing(self, minVal: float, maxVal: float, size: float) -> list[tuple[float, float]]:  # noqa: N802, N803
        """Steps between ticks and where they begin, the widest first, which has room for a line of text.

        Where only one number would be left of these, two are written that are no multiples of the step.
        """
        steps: list[tuple[float, float]] = super().tickSpacing(minVal, maxVal, size)
        line = QFontMetricsF(self.style["tickFont"] or self.font()).height()
        least = line * (maxVal - minVal) / max(size, 1.0)
        widest = steps[0][0]
        if self.orientation == "bottom" or widest >= least:
            return steps
        step = widest * math.ceil(least / widest)
        if math.floor(maxVal / step) > math.ceil(minVal / step):
            return [(step, 0.0), *steps]
        return [_outermost(minVal, maxVal, least, widest) or (step, 0.0), *steps]


def _outermost(low: float, high: float, least: float, step: float) -> tuple[float, float] | None:
    """Distance and place of two round numbers near the ends of an axis, half a line away, where these lie apart."""
    for each in (step, step / 2.0, step / 5.0, step / 10.0):
        first = each * math.ceil((low + least / 2.0) / each)
        last = each * math.floor((high - least / 2.0) / each)
        if last - first >= least:
            return last - first, first
    return None


class Plot(pg.PlotWidget):  # type: ignore[misc]  # pyqtgraph is not typed
    """Axes with a grid, a way back after the wheel, and values that can be read, copied and saved.

    Whoever draws lines and points, as items with names where there are several, has all that; what is drawn otherwise
    is told with `state`. `recoloured` says that the palette has changed.
    """

    recoloured = Signal()
    _look: tuple[Colours, QFont] | None = None
    """Colours and font that it was drawn in; None while its axes are being made."""

    def __init__(self, bottom: str, left: str, parent: QWidget | None = None) -> None:
        axes = {side: LocalAxis(side) for side in ("left", "bottom")}
        super().__init__(parent, axisItems=axes, enableMenu=False)
        self.hideButtons()
        Title(self.getPlotItem())
        self.way_back, self.crosshair = WayBack(self), Crosshair(self, self.values)
        self.menu = PlotMenu(self, self._deeds())
        self._stated: tuple[Series, ...] | None = None
        self.scene().sigMouseClicked.connect(self._hear_click)
        self.getPlotItem().setContentsMargins(0, 4, 8, 0)
        self.name_axes(bottom, left)
        self._recolour()

    def close(self) -> bool:
        """Hide it. pyqtgraph would take it apart, and what is left of it crashes where the size of text changes."""
        return bool(QWidget.close(self))

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """Small: plots share what room there is."""
        return QSize(300, 140)

    @property
    def colours(self) -> Colours:
        """What to draw with."""
        return colours(self)

    def name_axes(self, bottom: str, left: str) -> None:
        """Say what is drawn against what: the ordinate above the plot, where it is read without turning the head."""
        self._bottom, self._left = bottom, left
        self.setAccessibleName(f"{left}, {bottom}")
        for side in ("bottom", "left"):
            self.getAxis(side).enableAutoSIPrefix(False)
            self.getAxis(side).setStyle(maxTickLevel=1)  # a third kind of line takes as long as all others
        self.getAxis("bottom").setLabel(bottom)
        self._make_room()
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
    def mark_px(self) -> float:
        """How wide to draw a point, which grows with the text."""
        return float(_MARK_LINES * self.fontMetrics().height())

    @property
    def band(self) -> QColor:
        """For a range that marks and lines are drawn over."""
        tint = QColor(self.colours.accent)
        tint.setAlphaF(_BAND)
        return tint

    def fit_axes(self) -> None:
        """Fit the axes to what is drawn now: when it is painted it would be too late, and be painted twice."""
        self.scene().prepareForPaint()

    def begin_anew(self) -> None:
        """Forget what was seen of that which was drawn before."""
        self.crosshair.forget()
        self.way_back.begin_anew()

    def state(self, series: Iterable[Series]) -> None:
        """Say what is drawn, in place of what lines and points with names say by themselves."""
        self._stated = tuple(series)

    def values(self) -> Values:
        """What is drawn, as values."""
        series = tuple(items_of(self.getPlotItem())) if self._stated is None else self._stated
        return Values(bottom=self._bottom, left=self._left, series=series)

    @property
    def savable(self) -> Savable:
        """What a file of it holds; the file is called after the ordinate."""
        name = re.sub(r"\W+", "-", without_unit(self._left)).strip("-") or "plot"
        return Savable(name=name, plot=self, values=self.values)

    def copy_values(self) -> None:
        """Put what is drawn on the clipboard, as a table."""
        QGuiApplication.clipboard().setText(self.values().as_text())

    def save(self) -> None:
        """Have the window ask for a file, and write what is seen or what is drawn."""
        ask_to_save(self.savable)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Arrows go from point to point, up and down from series to series; the others do what the menu says."""
        match event.key():
            case Qt.Key.Key_Right | Qt.Key.Key_Left:
                self.crosshair.step(1 if event.key() == Qt.Key.Key_Right else -1)
            case Qt.Key.Key_Down | Qt.Key.Key_Up:
                self.crosshair.change_series(1 if event.key() == Qt.Key.Key_Down else -1)
            case _:
                pressed = QKeySequence(event.keyCombination())
                deed = next((each for each in self._deeds() if QKeySequence(each.key) == pressed), None)
                if deed is None:
                    super().keyPressEvent(event)
                else:
                    deed.do()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:  # noqa: N802  # Qt's name
        """Show the menu for the key of that name; the right button may begin a drag, and is heard when it is let go."""
        if event.reason() is QContextMenuEvent.Reason.Keyboard:
            self.menu.open_at(self.mapToGlobal(self.rect().center()))

    def enterEvent(self, event: QEnterEvent) -> None:  # noqa: N802  # Qt's name
        """Show the button of the menu."""
        super().enterEvent(event)
        self.menu.place()

    def leaveEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Hide it."""
        super().leaveEvent(event)
        self.menu.place()

    def focusInEvent(self, event: QFocusEvent) -> None:  # noqa: N802  # Qt's name
        """Show the button of the menu."""
        super().focusInEvent(event)
        self.menu.place()

    def focusOutEvent(self, event: QFocusEvent) -> None:  # noqa: N802  # Qt's name
        """Hide it, and the values that the keys have come to."""
        super().focusOutEvent(event)
        self.crosshair.forget()
        self.menu.place()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Keep the button in its corner."""
        super().resizeEvent(event)
        if self._look is not None:
            self.menu.place()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette."""
        super().changeEvent(event)
        if self._look is None or event.type() not in (QEvent.Type.PaletteChange, QEvent.Type.FontChange):
            return
        if self._look != (colours(self), self.font()):
            self._recolour()
            self.recoloured.emit()

    def _hear_click(self, event: Any) -> None:  # noqa: ANN401  # pyqtgraph is not typed
        if event.button() == Qt.MouseButton.RightButton:
            self.menu.open_at(event.screenPos().toPoint())

    def _deeds(self) -> tuple[Deed, ...]:
        return (
            Deed(title=tr("&Copy the values"), key="Ctrl+C", do=self.copy_values),
            Deed(title=tr("&Save…"), key="Ctrl+S", do=self.save),
            Deed(title=tr("One step &back"), key="Backspace", do=self.way_back.back),
            Deed(title=tr("The &whole picture"), key="Home", do=self.way_back.home),
        )

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
        self._make_room()
        self.entitle()
        self.showGrid(x=True, y=True, alpha=0.18)

    def _make_room(self) -> None:
        """Have the numbers of the abscissa and its name below each other, at any size of text."""
        lines = 2 if self._bottom else 1
        self.getAxis("bottom").setHeight(lines * self.fontMetrics().height() + _GAP_PX)

    def entitle(self, key: str = "") -> None:
        """Put a title above the plot: the ordinate, and a `key` to what is drawn, which so never hides it."""
        size = f"{self.font().pointSizeF():g}pt"
        self.getPlotItem().setTitle(self._left + key, color=colours(self).ink, size=size, justify="left")
