"""STOP by key and by mouse, heard before whatever has the keyboard or the mouse to itself."""

from typing import Final

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QMouseEvent, QShowEvent
from PySide6.QtWidgets import QApplication, QWidget

STOP_KEYS: Final = ("F12", "Pause", "Ctrl+.")
"""The first is written on the button. None of them types anything, and no part of the window uses them."""
_KINDS: Final = (QKeyEvent, QMouseEvent, QShowEvent)
"""What an event is costs less to tell than its type: there are thousands a second."""
_HEARD: Final = frozenset({QEvent.Type.KeyPress, QEvent.Type.MouseButtonPress, QEvent.Type.Show})


class StopGuard(QObject):
    """Sees every event of the application first: open menus, lists, dialogs and text fields take nothing from STOP.

    A press of the mouse counts where the button is, whatever lies over it; a menu or a list that opens there is moved
    off it.
    """

    wanted = Signal()

    def __init__(self, button: QWidget, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._button = button
        application = QApplication.instance()
        assert application is not None, "there is no window without an application"
        application.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Stop on the stop key, which goes no further, and on a press on STOP, which does."""
        if not isinstance(event, _KINDS) or event.type() not in _HEARD:
            return False
        if isinstance(event, QKeyEvent):
            return self._hear_key(event)
        if isinstance(event, QMouseEvent):
            self._hear_press(event)
        elif isinstance(watched, QWidget) and watched.windowType() is Qt.WindowType.Popup:
            self._clear(watched)
        return False

    def _hear_key(self, event: QKeyEvent) -> bool:
        if not is_stop_key(event):
            return False
        if not event.isAutoRepeat():
            self.wanted.emit()
        return True

    def _hear_press(self, event: QMouseEvent) -> None:
        popup = QApplication.activePopupWidget()  # without one the button hears it itself
        if popup is not None and self._button.isVisible() and self._place.contains(event.globalPosition().toPoint()):
            self.wanted.emit()

    def _clear(self, popup: QWidget) -> None:
        if self._button.isVisible() and popup.geometry().intersects(self._place):
            popup.move(popup.x(), self._place.top() - popup.height())

    @property
    def _place(self) -> QRect:
        """Of the button, on the screen."""
        return QRect(self._button.mapToGlobal(QPoint()), self._button.size())


def is_stop_key(event: QKeyEvent) -> bool:
    """Whether a key is one of `STOP_KEYS`, with Shift or on the keypad likewise."""
    kept = event.modifiers() & ~(Qt.KeyboardModifier.KeypadModifier | Qt.KeyboardModifier.ShiftModifier)
    return QKeySequence(event.key() | kept.value).toString() in STOP_KEYS
