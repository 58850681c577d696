"""The way from screen to screen."""

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QButtonGroup, QPushButton, QVBoxLayout, QWidget


class Navigation(QWidget):
    """One button for each screen, one above the other; Ctrl and its number presses it."""

    chosen = Signal(int)

    def __init__(self, titles: Sequence[str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._group = QButtonGroup(self)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(6, 8, 0, 8)
        for number, title in enumerate(titles):
            button = QPushButton(title)
            button.setObjectName("navigation")
            button.setCheckable(True)
            font = button.font()
            font.setBold(True)
            button.setFont(font)
            button.setShortcut(QKeySequence(f"Ctrl+{number + 1}"))
            button.setToolTip(f"Ctrl+{number + 1}")
            self._group.addButton(button, number)
            layout.addWidget(button)
        layout.addStretch(1)
        self._group.idToggled.connect(self._tell)

    @property
    def current(self) -> int:
        """Number of the screen that is shown, from 0."""
        return self._group.checkedId()

    def choose(self, number: int) -> None:
        """Show a screen."""
        button = self._group.button(number)
        if button is not None:
            button.setChecked(True)

    def _tell(self, number: int, checked: bool) -> None:
        if checked:
            self.chosen.emit(number)
