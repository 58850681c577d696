"""The page that says what the person at the stand has to do: amber, to be read from two metres."""

from typing import Final

from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QShowEvent
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QHBoxLayout,
    QLineEdit,
    QScrollArea,
    QScrollBar,
    QVBoxLayout,
    QWidget,
)

from tumble.window.look.tints import AMBER
from tumble.window.widgets.banner import Banner
from tumble.window.widgets.motion_button import MotionButton

_ROUND: Final = 8
_ANSWER_PT: Final = 20
_SETTLING_MS: Final = 40
"""The parts of a screen find their places one after the other."""


class WaitingPage(QFrame):
    """A picture, where there is one, beside words of 40 pt and more, one below the other, and what answers them.

    The answer, which is the last of the column, comes into sight with the question wherever that is scrolled; not while
    somebody types above, and after that no more once somebody has scrolled by hand.
    """

    def __init__(self, picture: QWidget | None = None, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.unit, self.words = Banner(), Banner()
        """Which unit it is, and what there is to do."""
        self.column = QVBoxLayout()
        self._seen_at: QPoint | None = None
        """Where the answer lay when it was brought into sight last."""
        self._bar: QScrollBar | None = None
        """Of what the page lies in, once that was looked for."""
        self._left_alone = False
        """Whether somebody has scrolled by hand since the question came."""
        self._laid_out = QTimer(self, singleShot=True, interval=_SETTLING_MS)
        self._laid_out.timeout.connect(self._bring_answer)
        for banner in (self.unit, self.words):
            banner.hide()
            self.column.addWidget(banner)
        self.column.addStretch(1)
        across = QHBoxLayout(self)
        if picture is not None:
            across.addWidget(_on_paper(picture), stretch=1)
        across.addLayout(self.column, stretch=2)

    def show_unit(self, unit: str) -> None:
        """Say which unit it is, see `sentences.unit_text`."""
        _say(self.unit, unit)

    def say(self, words: str) -> None:
        """Say what there is to do."""
        if words != self.words.text:
            self._look_for_answer()
        _say(self.words, words)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Come with the answer in sight."""
        super().showEvent(event)
        self._left_alone = False
        self._look_for_answer()

    def _look_for_answer(self) -> None:
        self._seen_at = None
        self._laid_out.start()

    def _bring_answer(self) -> None:
        """Scroll what the page lies in as far as the answer needs, until that stays where it is."""
        area, last = _area_of(self), self.column.itemAt(self.column.count() - 1)
        screen, answer = area and area.widget(), last and last.widget()
        if not (area and screen and answer and answer.isVisible()):
            return
        self._heed(area.verticalScrollBar())
        if self._left_alone or _types(screen, self):
            return
        place = answer.mapTo(screen, answer.rect().bottomLeft())
        area.ensureVisible(place.x(), place.y(), 0, _ROUND)  # `ensureWidgetVisible` goes by the cursor of a field
        if place != self._seen_at:
            self._seen_at = place
            self._laid_out.start()

    def _heed(self, bar: QScrollBar) -> None:
        """Notice who scrolls by hand: what a program scrolls is no action of the bar."""
        if self._bar is not bar:
            self._bar = bar
            bar.actionTriggered.connect(self._leave_alone)

    def _leave_alone(self, _action: int) -> None:
        self._left_alone = True

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


def _area_of(part: QWidget) -> QScrollArea | None:
    """What a part is scrolled in; None where it is not."""
    around = part.parentWidget()
    while around is not None and not isinstance(around, QScrollArea):
        around = around.parentWidget()
    return around


def _types(screen: QWidget, page: QWidget) -> bool:
    """Whether somebody has begun to write in a field of a screen, and not on the page."""
    field = QApplication.focusWidget()
    elsewhere = field is not None and screen.isAncestorOf(field) and not page.isAncestorOf(field)
    return elsewhere and isinstance(field, QLineEdit) and field.isModified() and bool(field.text())


def _on_paper(picture: QWidget) -> QFrame:
    card = QFrame()
    card.setObjectName("card")
    QVBoxLayout(card).addWidget(picture)
    return card
