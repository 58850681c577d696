"""What can be done with a plot: a button in its corner, and its menu."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QMenu, QToolButton

from tumble.window.look.language import tr

_MARGIN_PX: Final = 2


@dataclass(frozen=True, kw_only=True)
class Deed:
    """Something that can be done."""

    title: str
    key: str
    """That does it, too."""
    do: Callable[[], None]


class PlotMenu(QToolButton):
    """Three dots in the corner, there while the mouse is over the plot, or the plot has the keyboard."""

    def __init__(self, plot: pg.PlotWidget, deeds: Sequence[Deed]) -> None:
        super().__init__(plot.viewport())
        self._plot, self._deeds = plot, deeds
        self.setText("⋯")
        self.setToolTip(tr("What can be done with this plot"))
        self.setAccessibleName(self.toolTip())
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.clicked.connect(lambda: self.open_at(self.mapToGlobal(self.rect().bottomLeft())))
        self.hide()

    def place(self) -> None:
        """Stand in the corner, or hide."""
        self.adjustSize()
        self.move(self._plot.viewport().width() - self.width() - _MARGIN_PX, _MARGIN_PX)
        self.setVisible(self._plot.hasFocus() or self._plot.underMouse())

    def open_at(self, place: QPoint) -> None:
        """Show the menu at a place of the screen."""
        menu = QMenu(self._plot)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for deed in self._deeds:
            key = QKeySequence(deed.key).toString(QKeySequence.SequenceFormat.NativeText)
            menu.addAction(f"{deed.title}\t{key}", deed.do)
        menu.popup(place)
