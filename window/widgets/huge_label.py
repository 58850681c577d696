"""Text as large as its place allows, to be read from two metres."""

from typing import Final

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

_TRIED_PX: Final = 100


class HugeLabel(QWidget):
    """One line in the colour `ink` that fills its width or its height, whichever it comes to first."""

    def __init__(self, ink: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text, self._ink = "", ink
        self.setMinimumSize(160, 48)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As much as there is."""
        return QSize(640, 120)

    @property
    def text(self) -> str:
        """What it says."""
        return self._text

    def say(self, text: str) -> None:
        """Say something else."""
        self._text = text
        self.setAccessibleName(text)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it."""
        if not self._text:
            return
        painter = QPainter(self)
        font = self.font()
        font.setBold(True)
        font.setPixelSize(_TRIED_PX)
        tried = QFontMetricsF(font)
        by_width = self.width() * 0.96 / max(tried.horizontalAdvance(self._text), 1.0)
        by_height = self.height() * 0.92 / tried.height()
        font.setPixelSize(max(10, int(_TRIED_PX * min(by_width, by_height))))
        painter.setFont(font)
        painter.setPen(QColor(self._ink))
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, self._text)
