"""The way back in a plot that was zoomed or moved: one step, or to the whole picture."""

from collections.abc import Callable
from typing import Final, TypeAlias

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from tumble.window.look.language import tr

Ranges: TypeAlias = list[list[float]]
"""Lowest and highest abscissa, and lowest and highest ordinate."""
_BESIDE_PX: Final = 40
"""Room for the button of the menu."""
_BEFORE_A_CHANGE: Final = (QEvent.Type.Wheel, QEvent.Type.MouseButtonPress)


class WayBack(QWidget):
    """Two buttons in the corner of a plot, there as soon as somebody has changed what is seen of it.

    Wheel and mouse end the fitting of the axes to the data; the whole picture begins it again.
    """

    def __init__(self, plot: pg.PlotWidget) -> None:
        super().__init__(plot.viewport())
        self._box, self._plot = plot.getViewBox(), plot
        self._before: Ranges = self._box.viewRange()
        self._steps: list[Ranges] = []
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.back_button = self._button("↶", tr("One step back  [Backspace]"), self.back)
        self.home_button = self._button("⌂", tr("The whole picture  [Home, double click]"), self.home)
        for button in (self.back_button, self.home_button):
            layout.addWidget(button)
        self.hide()
        self._box.sigRangeChangedManually.connect(self._remember)
        plot.viewport().installEventFilter(self)

    def home(self) -> None:
        """Show everything that is drawn, and go on doing so; with the abscissa of another plot, as that one has it."""
        self._steps.clear()
        abscissa = self._box.linkedView(0) or self._box
        abscissa.enableAutoRange(axis=self._box.XAxis)
        self._box.enableAutoRange(axis=self._box.YAxis)
        for box in (abscissa, self._box):
            box.updateAutoRange()
        self._place()

    def back(self) -> None:
        """Show what was seen before the last change."""
        if len(self._steps) < 2:  # what was seen before the first was the whole picture
            self.home()
            return
        x, y = self._steps.pop()
        self._box.setRange(xRange=x, yRange=y, padding=0, disableAutoRange=True)
        self._place()

    def begin_anew(self) -> None:
        """Forget the axes of what was drawn before: what comes has its own."""
        self._box.setRange(xRange=(0, 1), yRange=(0, 1), padding=0)
        self.home()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Remember what is seen before it is changed; a double click shows everything."""
        if event.type() in _BEFORE_A_CHANGE:
            self._before = self._box.viewRange()
        elif event.type() == QEvent.Type.MouseButtonDblClick:
            self.home()
        elif event.type() == QEvent.Type.Resize:
            self._place()
        return super().eventFilter(watched, event)

    def _remember(self) -> None:
        """Keep a step; a drag of the mouse is one."""
        if not self._steps or self._steps[-1] != self._before:
            self._steps.append(self._before)
        self._place()

    def _place(self) -> None:
        self.setVisible(bool(self._steps))
        self.adjustSize()
        self.move(self._plot.viewport().width() - self.width() - _BESIDE_PX, 2)

    def _button(self, sign: str, tooltip: str, do: Callable[[], None]) -> QToolButton:
        button = QToolButton()
        button.setText(sign)
        button.setToolTip(tooltip)
        button.setAccessibleName(tooltip)
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        button.clicked.connect(do)
        return button
