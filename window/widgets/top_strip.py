"""The strip above every screen: stand, unit, operator, and where the run stands."""

from collections.abc import Mapping
from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QWidget

from tumble.window.look.names import short_name
from tumble.window.look.plain import PlainLabel, as_tooltip
from tumble.window.look.tints import AMBER, BLUE, GREY, RED, VIOLET, Tint
from tumble.window.screens.run_state import Mood
from tumble.window.widgets.banner import Banner

_TINTS: Final[Mapping[Mood, Tint]] = {
    Mood.READY: GREY,
    Mood.MEASURING: BLUE,
    Mood.WAITING: AMBER,
    Mood.PAUSED: VIOLET,
    Mood.FAULT: RED,
}
_FEWEST_LETTERS: Final = 90
"""Below this width, in letters of the usual text, the names stand above the state and not beside it."""


class TopStrip(QWidget):
    """Names beside the state; above it where there is no room, as with text of 200% on a small screen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.names, self.state = PlainLabel(), Banner()
        self.names.setObjectName("heading")
        self.names.setWordWrap(True)
        self._parts: dict[str, str] = {}
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._row.setContentsMargins(8, 6, 8, 0)
        self._row.addWidget(self.names, 1)
        self._row.addWidget(self.state, 3)

    def show_stand(self, name: str) -> None:
        """Show another stand."""
        self._show(stand=name)

    def show_unit(self, serial_number: str, operator: str) -> None:
        """Show another unit, and who measures it; empty where there is none."""
        self._show(unit=serial_number, operator=operator)

    def show_state(self, text: str, mood: Mood) -> None:
        """Show where the run stands."""
        self.state.say(text, _TINTS[mood])

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Fold where there is little room."""
        super().resizeEvent(event)
        letters = self.width() / max(self.fontMetrics().averageCharWidth(), 1)
        beside = letters >= _FEWEST_LETTERS
        direction = QBoxLayout.Direction
        self._row.setDirection(direction.LeftToRight if beside else direction.TopToBottom)
        self.names.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)

    def _show(self, **parts: str) -> None:
        self._parts |= parts
        given = list(filter(None, self._parts.values()))
        self.names.setText(" · ".join(map(short_name, given)))
        self.names.setToolTip(as_tooltip(" · ".join(given)))
