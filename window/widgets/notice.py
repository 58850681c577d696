"""Notices: what a person shall know and need not decide. They lie over a corner of the screens and take no focus."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Final

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QAccessible, QAccessibleEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from tumble.window.look.keys import key_text
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel

ACT_KEY: Final = "F11"
"""Does what the newest notice offers; no scanner types it."""
_READ_MS: Final = 10_000
"""How long what went as it should is shown."""
_LETTERS: Final = 62
"""Width of a notice."""
_SHARE: Final = 0.6
"""Of the width of the window, at most."""


class Kind(StrEnum):
    """What a notice tells of; each has a sign."""

    TOLD = "ℹ"  # the sign is meant
    FAULT = "⚠"


@dataclass(frozen=True, kw_only=True)
class Action:
    """What can be done about it."""

    title: str
    act: Callable[[], None]
    about: Path | None = None
    """The file that it does something with, where that may be done elsewhere, too."""


@dataclass(frozen=True, kw_only=True)
class Notice:
    """A sentence or two, and what can be done about it."""

    text: str
    kind: Kind = Kind.TOLD
    details: str = ""
    action: Action | None = None


class NoticeCard(QFrame):
    """One notice; the mouse closes it, or does what it offers."""

    dismissed = Signal()

    def __init__(self, notice: Notice, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.notice = notice
        self.setObjectName("notice_fault" if notice.kind is Kind.FAULT else "over")
        self.setAccessibleName(notice.text)
        self.setAccessibleDescription(notice.details)
        self._act, self._close = _button(self.act), _button(self.dismiss)
        self._close.setAccessibleName(tr("Close"))
        self._act.setVisible(notice.action is not None)
        self._lay_out()
        self.hint(False)

    def hint(self, is_newest: bool) -> None:
        """Name the keys, which are those of the newest notice."""
        keys = (f"  [{key_text(ACT_KEY)}]", "  [Esc]") if is_newest else ("", "")
        self._act.setText((self.notice.action.title if self.notice.action else "") + keys[0])
        self._close.setText(f"✕{keys[1]}")

    def act(self) -> None:
        """Do what it offers, and close it."""
        self.dismiss()
        if self.notice.action is not None:
            self.notice.action.act()

    def dismiss(self) -> None:
        """Close it."""
        self.hide()
        self.deleteLater()
        self.dismissed.emit()

    def _lay_out(self) -> None:
        sign = PlainLabel(self.notice.kind.value)
        sign.setObjectName("bad" if self.notice.kind is Kind.FAULT else "heading")
        across = QHBoxLayout()
        across.addWidget(sign, 0, Qt.AlignmentFlag.AlignTop)
        words = QVBoxLayout()
        for text in filter(None, (self.notice.text, self.notice.details)):
            label = PlainLabel(text)
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            label.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            words.addWidget(label)
        across.addLayout(words, stretch=1)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        buttons.addWidget(self._act)
        buttons.addWidget(self._close)
        column = QVBoxLayout(self)
        column.addLayout(across)
        column.addLayout(buttons)


class Notices(QWidget):
    """Notices on each other in the lower right corner of a place, the newest at the bottom.

    One that says the same as another takes its place. What has no room waits above, and is counted. Faults stay until
    they are closed; what else there is to tell goes by itself, unless the mouse is on it.
    """

    def __init__(self, place: QWidget) -> None:
        super().__init__(place)
        self.cards: list[NoticeCard] = []
        """The newest last."""
        self._place, self._earlier = place, PlainLabel()
        self._earlier.setObjectName("pale")
        self._earlier.setAlignment(Qt.AlignmentFlag.AlignRight)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.addWidget(self._earlier)
        self._wait = QTimer(self, interval=_READ_MS, singleShot=True)
        self._wait.timeout.connect(self._let_go)
        place.installEventFilter(self)
        self.hide()

    def show_notice(self, notice: Notice) -> None:
        """Show a notice, and say it to whoever is read to."""
        for card in self.cards[:]:
            if card.notice.text == notice.text:
                card.dismiss()
        card = NoticeCard(notice)
        card.dismissed.connect(lambda: self._forget(card))
        self.cards.append(card)
        self._column.addWidget(card)
        self._arrange()
        QAccessible.updateAccessibility(QAccessibleEvent(card, QAccessible.Event.Alert))

    def withdraw(self, about: Path) -> None:
        """Close what offers something with a file: it is being done."""
        for card in self.cards[:]:
            offered = card.notice.action.about if card.notice.action else None
            if offered is not None and offered.resolve() == about.resolve():
                card.dismiss()

    def act_newest(self) -> None:
        """Do what the newest notice offers; nothing where it offers nothing."""
        if self.cards and self.cards[-1].notice.action is not None:
            self.cards[-1].act()

    def close_newest(self) -> bool:
        """Close the newest notice; false where there is none."""
        if not self.cards:
            return False
        self.cards[-1].dismiss()
        return True

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Stay in the corner."""
        if watched is self._place and event.type() in (QEvent.Type.Resize, QEvent.Type.Show):
            self._arrange()
        return super().eventFilter(watched, event)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Grow with the text."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._arrange()

    def _forget(self, card: NoticeCard) -> None:
        self.cards.remove(card)
        self._column.removeWidget(card)
        self._arrange()

    def _let_go(self) -> None:
        if self.underMouse():
            self._wait.start()
            return
        for card in [card for card in self.cards if card.notice.kind is Kind.TOLD]:
            card.dismiss()

    def _arrange(self) -> None:
        self.setVisible(bool(self.cards))
        if not self.cards:
            return
        width = min(_LETTERS * self.fontMetrics().averageCharWidth(), round(_SHARE * self._place.width()))
        shown = self._that_fit(width)
        for place, card in enumerate(self.cards):
            card.setVisible(card in shown)
            card.hint(place == len(self.cards) - 1)
        hidden = len(self.cards) - len(shown)
        self._earlier.setText(tr("{count} earlier", count=hidden) if hidden else "")
        self._earlier.setVisible(bool(hidden))
        self._column.activate()
        height = self._column.heightForWidth(width)
        self.resize(width, min(height, self._place.height()))
        self.move(self._place.width() - width - 8, max(self._place.height() - height - 8, 0))
        self.raise_()
        self._wait.start()

    def _that_fit(self, width: int) -> list[NoticeCard]:
        """The newest ones, as many as there is room for; the newest of all in any case."""
        room = self._place.height() - 2 * self.fontMetrics().height()
        shown: list[NoticeCard] = []
        for card in reversed(self.cards):
            layout = card.layout()
            room -= (layout.heightForWidth(width) if layout else 0) + self._column.spacing()
            if shown and room < 0:
                break
            shown.append(card)
        return shown


def _button(do: Callable[[], None]) -> QPushButton:
    button = QPushButton()
    button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    button.clicked.connect(lambda _checked: do())
    return button
