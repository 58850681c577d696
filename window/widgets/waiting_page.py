"""The page that says what the person at the stand has to do: amber, to be read from two metres."""

from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout, QWidget

from tumble.window.look.tints import AMBER
from tumble.window.widgets.banner import Banner
from tumble.window.widgets.motion_button import MotionButton

_ROUND: Final = 8
_ANSWER_PT: Final = 20


class WaitingPage(QFrame):
    """A picture, where there is one, beside words of 40 pt and more, one below the other, and what answers them."""

    def __init__(self, picture: QWidget | None = None, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.unit, self.words = Banner(), Banner()
        """Which unit it is, and what there is to do."""
        self.column = QVBoxLayout()
        for banner in (self.unit, self.words):
            banner.hide()
            self.column.addWidget(banner)
        self.column.addStretch(1)
        across = QHBoxLayout(self)
        if picture is not None:
            across.addWidget(_on_paper(picture), stretch=1)
        across.addLayout(self.column, stretch=2)

    def show_unit(self, serial_number: str) -> None:
        """Say which unit it is."""
        _say(self.unit, serial_number)

    def say(self, words: str) -> None:
        """Say what there is to do."""
        _say(self.words, words)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Lay the ground."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(AMBER.ground))
        painter.drawRoundedRect(self.rect(), _ROUND, _ROUND)


def answer_button(text: str) -> MotionButton:
    """What says that it is done: as dark on amber as the words, light or dark the window."""
    button = MotionButton(text, "F9")
    button.setStyleSheet(
        f"background: {AMBER.ink}; color: {AMBER.ground}; border: none; border-radius: {_ROUND}px; "
        f"font-weight: bold; font-size: {_ANSWER_PT}pt;"
    )
    return button


def _say(banner: Banner, text: str) -> None:
    if banner.text != text:
        banner.say(text, AMBER)
    banner.setVisible(bool(text))


def _on_paper(picture: QWidget) -> QFrame:
    card = QFrame()
    card.setObjectName("card")
    QVBoxLayout(card).addWidget(picture)
    return card
