"""What stands above a plot."""

from typing import Any, Final

import pyqtgraph as pg
from PySide6.QtCore import Qt

_LEAST_PX: Final = 40.0
"""A plot that is narrower has not been laid out yet."""
_NOT_WRAPPED: Final = -1.0
"""Qt's word for any width."""


class Title(pg.LabelItem):  # type: ignore[misc]  # pyqtgraph is not typed
    """Wraps where it is longer than its plot is wide, and takes as many lines as that needs.

    pyqtgraph's own has one line, and makes a plot as wide as that, whose right end nobody then sees.
    """

    def __init__(self, plot: pg.PlotItem) -> None:
        self._rows = plot.layout
        super().__init__()
        self._rows.removeItem(plot.titleLabel)
        plot.titleLabel.scene().removeItem(plot.titleLabel)
        plot.titleLabel = self
        self._rows.addItem(self, 0, 1)

    def resizeEvent(self, event: Any) -> None:  # noqa: ANN401, N802  # Qt's name; pyqtgraph gives none
        """Wrap at the width that there is."""
        width = self.rect().width()
        self.item.setTextWidth(width if width > _LEAST_PX else _NOT_WRAPPED)
        super().resizeEvent(event)

    def updateMin(self) -> None:  # noqa: N802  # its name
        """Ask for the height of the text, and for no width."""
        height = self.item.boundingRect().height()
        self._sizeHint = {
            Qt.SizeHint.MinimumSize: (0.0, height),
            Qt.SizeHint.PreferredSize: (0.0, height),
            Qt.SizeHint.MaximumSize: (-1.0, -1.0),
        }
        self.setMaximumHeight(height)
        self.setMinimumSize(0.0, height)
        self._rows.setRowFixedHeight(0, height)
        self.updateGeometry()
