"""A few words on a coloured ground, to be read from two metres."""

from typing import Final

from PySide6.QtCore import QEvent, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from tumble.window.look.theme import POINT_SIZE
from tumble.window.look.tints import GREY, Tint

LEAST_PT: Final = 40.0
_MARGIN: Final = 8
_WRAPPED: Final = int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap)
_ENDLESS: Final = 10_000
_FILLED: Final = 0.97
"""Of the width, at most: letters do not grow quite as their size does, and must not wrap for that."""


class Banner(QWidget):
    """40 pt at the usual size of text, and more with larger text as far as the words stay on one line."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text, self.tint = "", GREY
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    @property
    def text(self) -> str:
        """What it says."""
        return self._text

    def say(self, text: str, tint: Tint) -> None:
        """Say something else."""
        self._text, self.tint = text, tint
        self.setAccessibleName(text)
        self.updateGeometry()
        self.update()

    def point_size(self, width: int) -> float:
        """Size of its letters at a width in pixels: wrapped words have the least."""
        wished = LEAST_PT * self.font().pointSizeF() / POINT_SIZE
        needed = QFontMetrics(self._sized(wished)).horizontalAdvance(self._text)
        return max(LEAST_PT, min(wished, _FILLED * wished * (width - 2 * _MARGIN) / max(needed, 1)))

    def heightForWidth(self, width: int) -> int:  # noqa: N802  # Qt's name
        """As high as the words are at a width."""
        metrics = QFontMetrics(self._sized(self.point_size(width)))
        box = QRect(0, 0, max(width - 2 * _MARGIN, 1), _ENDLESS)
        return max(metrics.boundingRect(box, _WRAPPED, self._text).height(), metrics.height()) + _MARGIN

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As wide as may be."""
        return QSize(640, self.heightForWidth(640))

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """One line."""
        return QSize(200, self.heightForWidth(_ENDLESS))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Grow with the text size, at once."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.updateGeometry()
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self.tint.ground))
        painter.drawRoundedRect(self.rect(), _MARGIN, _MARGIN)
        painter.setPen(QColor(self.tint.ink))
        painter.setFont(self._sized(self.point_size(self.width())))
        painter.drawText(self.rect().adjusted(_MARGIN, 0, -_MARGIN, 0), _WRAPPED, self._text)

    def _sized(self, size_pt: float) -> QFont:
        font = QFont(self.font())
        font.setBold(True)
        font.setPointSizeF(size_pt)
        return font
