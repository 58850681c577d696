"""A button that starts motion."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QShortcutEvent
from PySide6.QtWidgets import QPushButton, QWidget

from tumble.window.look.keys import chosen_key, key_text


class MotionButton(QPushButton):
    """Pressed by the mouse or by its own function key, and by nothing that a barcode scanner can type.

    It takes no focus, so that neither Enter nor a space ever presses it.
    """

    def __init__(self, text: str, usual_key: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.usual_key = usual_key
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAutoDefault(False)
        self.entitle(text)

    def entitle(self, text: str) -> None:
        """Say what it starts."""
        self._title = text
        self.setAccessibleName(text)
        self.take_key()

    @property
    def key_title(self) -> str:
        """What its key does."""
        return self.accessibleName()

    def take_key(self) -> None:
        """Go by the key that is chosen now."""
        self.setText(f"{self._title}  [{key_text(self.usual_key)}]")
        self.setShortcut(chosen_key(self.usual_key))  # the text takes it away

    def event(self, event: QEvent) -> bool:
        """Act while the key goes down: a tenth of a second later, as Qt would, the next scan is in the form."""
        if isinstance(event, QShortcutEvent) and not event.isAmbiguous():
            self.click()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Leave every key to others: the function key comes as a shortcut."""
        event.ignore()
