"""Parts one below the other, for a place that asks how high they must be."""

from collections.abc import Sequence

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget


class Column(QWidget):
    """Asks for the height that its wrapped texts need at its width, as a splitter does not do by itself."""

    def __init__(self, parts: Sequence[QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        for part in parts:
            self._column.addWidget(part)
        self._column.addStretch(1)

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As high as the texts are when they are wrapped."""
        least, width = self._column.minimumSize(), self.width()
        wraps = self._column.hasHeightForWidth() and width >= least.width()
        return least.expandedTo(QSize(0, self._column.minimumHeightForWidth(width))) if wraps else least

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Ask anew at another width."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()
