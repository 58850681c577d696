"""What can be done with a part of the window: actions that its buttons and its menu share."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QContextMenuEvent, QKeySequence
from PySide6.QtWidgets import QMenu, QPushButton, QWidget


class ActionButton(QPushButton):
    """Says what its action says, can be pressed while that can be done, and does it."""

    def __init__(self, action: QAction, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.action = action
        self.clicked.connect(lambda _checked: action.trigger())
        action.changed.connect(self._follow)
        self._follow()

    def _follow(self) -> None:
        action = self.action
        if self.text() != action.text():
            self.setText(action.text())
        self.setToolTip(action.shortcut().toString(QKeySequence.SequenceFormat.NativeText))
        self.setEnabled(action.isEnabled())


def open_menu(part: QWidget, event: QContextMenuEvent) -> None:
    """Show the actions of a part where the mouse is, or by the key Menu at its cursor; waits for nobody."""
    menu = QMenu(part)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    menu.addActions(part.actions())
    menu.popup(event.globalPos())
    event.accept()
