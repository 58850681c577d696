"""Parts beside each other, or below each other where they have no room."""

from collections.abc import Sequence

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QPushButton, QWidget


class FoldingRow(QWidget):
    """The first part takes what room there is; the others are as wide as they want to be."""

    def __init__(self, parts: Sequence[QWidget], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._parts = tuple(parts)
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSizeConstraint(QBoxLayout.SizeConstraint.SetNoConstraint)
        for place, part in enumerate(self._parts):
            self._row.addWidget(part, 0 if place else 1)

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As wide as the widest part, and as high as they are where they stand now."""
        widest = max(part.minimumSizeHint().width() for part in self._parts)
        width = max(self.width(), widest)
        high = self._row.minimumHeightForWidth(width) if self._row.hasHeightForWidth() else 0
        return QSize(widest, max(high, self._row.minimumSize().height()))

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """The same."""
        return self.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Fold, or unfold."""
        super().resizeEvent(event)
        gaps = self._row.spacing() * (len(self._parts) - 1)
        needed = sum(part.minimumSizeHint().width() for part in self._parts) + gaps
        ways = QBoxLayout.Direction
        self._row.setDirection(ways.LeftToRight if needed <= self.width() else ways.TopToBottom)
        self.updateGeometry()


def buttons_at_left(buttons: Sequence[QPushButton]) -> QWidget:
    """Buttons that stay beside each other, as wide as they want to be wherever there is more room."""
    together = buttons_beside(buttons)
    room = QWidget()
    across = QHBoxLayout(room)
    across.setContentsMargins(0, 0, 0, 0)
    across.addWidget(together)
    across.addStretch(1)
    return room


def buttons_beside(buttons: Sequence[QPushButton]) -> QWidget:
    """Buttons that stay beside each other."""
    together = QWidget()
    across = QHBoxLayout(together)
    across.setContentsMargins(0, 0, 0, 0)
    for button in buttons:
        across.addWidget(button)
    return together
