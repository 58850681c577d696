"""The keys of the window, each in a field that takes the next key that is pressed."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QGridLayout, QKeySequenceEdit, QLabel, QPushButton, QWidget

from tumble.window.look.keys import choose_key, forget_keys
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.shortcuts import Shortcut, refusal


class KeyField(QKeySequenceEdit):
    """One key at a time; Tab goes on to the next field."""

    def __init__(self, shortcut: Shortcut, parent: QWidget | None = None) -> None:
        super().__init__(shortcut.chosen, parent)
        self.setMaximumSequenceLength(1)
        self.setFinishingKeyCombinations([])
        self.setAccessibleName(shortcut.title)
        self.shortcut = shortcut

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Take a key, those excepted that go from field to field."""
        if event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            self.focusNextPrevChild(event.key() == Qt.Key.Key_Tab)
        else:
            super().keyPressEvent(event)


class KeyFields(QWidget):
    """A line for each key; one that cannot be is refused in a sentence, and the one before stays."""

    changed = Signal()

    def __init__(self, find: Callable[[], Sequence[Shortcut]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._find = find
        self.fields: dict[str, KeyField] = {}
        """By the usual key."""
        self.said = PlainLabel()
        self.said.setObjectName("bad")
        self.said.setWordWrap(True)
        self.usual_button = QPushButton(tr("All as usual"))
        self.usual_button.clicked.connect(self._forget)
        self._grid = QGridLayout(self)
        self._grid.setColumnStretch(0, 1)

    def show_keys(self) -> None:
        """Show the keys as they are now."""
        while (item := self._grid.takeAt(0)) is not None:
            before = item.widget()
            if before is not None and before not in (self.said, self.usual_button):
                before.hide()  # it is deleted when the event loop comes to it
                before.deleteLater()
        self.fields = {each.usual: self._field(each) for each in self._find()}
        for row, field in enumerate(self.fields.values()):
            title = QLabel(field.shortcut.title)
            title.setTextFormat(Qt.TextFormat.PlainText)
            title.setWordWrap(True)
            self._grid.addWidget(title, row, 0)
            self._grid.addWidget(field, row, 1)
        last = len(self.fields)
        self._grid.addWidget(self.said, last, 0)
        self._grid.addWidget(self.usual_button, last, 1)

    def _field(self, shortcut: Shortcut) -> KeyField:
        field = KeyField(shortcut)
        field.keySequenceChanged.connect(lambda keys: self._choose(field, keys))
        return field

    def _choose(self, field: KeyField, wanted: QKeySequence) -> None:
        before = field.shortcut.chosen
        if wanted.isEmpty() or wanted == before:
            return
        self.said.setText(refusal(wanted, field.shortcut, self._find()))
        if self.said.text():
            field.setKeySequence(before)
            return
        choose_key(field.shortcut.usual, wanted)
        self.changed.emit()

    def _forget(self) -> None:
        forget_keys()
        self.said.clear()
        self.changed.emit()
        self.show_keys()
