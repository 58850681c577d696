"""A field over the screens in which whatever the window can do is found, and done, by the keyboard alone."""

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QFrame, QLineEdit, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from tumble.window.finder.command import Command
from tumble.window.finder.fuzzy import score
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.widgets.dialog import YES_KEY

_SHOWN: Final = 60
"""Commands in the list, at most; more letters find the others."""
_LINES: Final = 11
_LETTERS: Final = 80
_STEPS: Final = {
    Qt.Key.Key_Down: 1,
    Qt.Key.Key_Up: -1,
    Qt.Key.Key_PageDown: _LINES - 1,
    Qt.Key.Key_PageUp: 1 - _LINES,
}


class Finder(QFrame):
    """Type, choose with the arrows, Enter does it. What starts motion wants F3, which no scanner types."""

    def __init__(self, place: QWidget) -> None:
        super().__init__(place)
        self.setObjectName("over")
        self.setAccessibleName(tr("Find a command"))
        self._place = place
        self._commands: list[Command] = []
        self._found: list[Command] = []
        self._before: QWidget | None = None
        self.field, self.list, self.said = QLineEdit(), QListWidget(), PlainLabel()
        self.field.setPlaceholderText(tr("a screen, a command, a stand, a unit"))
        self.field.setAccessibleName(tr("Find a command"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.said.setObjectName("pale")
        self.said.setWordWrap(True)
        column = QVBoxLayout(self)
        for part in (self.field, self.list, self.said):
            column.addWidget(part)
        self.field.textChanged.connect(self._search)
        self.list.itemClicked.connect(lambda _: self.do_chosen())
        self.list.currentRowChanged.connect(lambda _: self._tell())
        self.field.installEventFilter(self)
        place.installEventFilter(self)
        self.hide()

    @property
    def chosen(self) -> Command | None:
        """The command on which the list stands."""
        row = self.list.currentRow()
        return self._found[row] if 0 <= row < len(self._found) else None

    @property
    def titles(self) -> list[str]:
        """What is found, the best first."""
        return [command.name for command in self._found]

    def open(self, commands: Sequence[Command]) -> None:
        """Show what can be done now."""
        self._before = QApplication.focusWidget()
        self._commands = list({command.name: command for command in reversed(commands)}.values())[::-1]
        self.field.clear()
        self._search()
        self._fit()
        self.show()
        self.raise_()
        self.field.setFocus()

    def add(self, commands: Sequence[Command]) -> None:
        """Add what was found out only now."""
        self._commands.extend(commands)
        self._search()

    def close_it(self) -> bool:
        """Go back to where one was; false where it was not open."""
        if self.isHidden():
            return False
        self.hide()
        if self._before is not None:
            self._before.setFocus()
        return True

    def do_chosen(self) -> None:
        """Close, and do what is chosen."""
        if (command := self.chosen) is not None:
            self.close_it()
            command.do()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Hear the keys of the field, before a question has them; stay in the middle."""
        if watched is self._place and event.type() == QEvent.Type.Resize:
            self._fit()
        if watched is self.field and isinstance(event, QKeyEvent):
            if event.type() == QEvent.Type.ShortcutOverride and _is_yes(event):
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyPress:
                return self._hear(event)
        return super().eventFilter(watched, event)

    def _hear(self, event: QKeyEvent) -> bool:
        key = Qt.Key(event.key())
        if key in _STEPS:
            row = self.list.currentRow() + _STEPS[key]
            self.list.setCurrentRow(max(0, min(row, self.list.count() - 1)))
        elif key == Qt.Key.Key_Escape:
            self.close_it()
        elif _is_yes(event) or (key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and not self._wants_yes):
            self.do_chosen()
        else:
            return key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
        return True

    @property
    def _wants_yes(self) -> bool:
        return self.chosen is not None and self.chosen.moves

    def _search(self) -> None:
        typed = self.field.text()
        scored = [(score(typed, command.name), command) for command in self._commands]
        fitting = [(each, command) for each, command in scored if each is not None]
        fitting.sort(key=lambda pair: -pair[0])
        self._found = [command for _, command in fitting[:_SHOWN]]
        self.list.clear()
        for command in self._found:
            item = QListWidgetItem(command.name + (f"   [{command.key}]" if command.key else ""))
            self.list.addItem(item)
        self.list.setCurrentRow(0)
        self._tell()

    def _tell(self) -> None:
        if not self._found:
            text = tr("Nothing is called like that.")
        elif self._wants_yes:
            text = tr("This starts motion: {key} does it, Enter does not. Esc closes.", key=YES_KEY)
        else:
            text = tr("Enter does it, Esc closes.")
        self.said.setText(text)

    def _fit(self) -> None:
        line = self.fontMetrics().height()
        width = min(_LETTERS * self.fontMetrics().averageCharWidth(), self._place.width() - 32)
        height = min((_LINES + 6) * line + 40, self._place.height() - 8)
        self.setGeometry((self._place.width() - width) // 2, 4, width, height)


def _is_yes(event: QKeyEvent) -> bool:
    return event.key() == Qt.Key.Key_F3 and event.modifiers() == Qt.KeyboardModifier.NoModifier
