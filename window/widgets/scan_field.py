"""A name that is typed or scanned."""

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QLineEdit


class ScanField(QLineEdit):
    """What is scanned after a click takes the place of what was there; Qt would write it behind that.

    It takes a text of any length, and leaves it to whoever reads it to refuse one: of two units whose names were cut
    one could not tell the other.
    """

    def focusInEvent(self, event: QFocusEvent) -> None:  # noqa: N802  # Qt's name
        """Select everything, as Qt does where a key leads here."""
        super().focusInEvent(event)
        if event.reason() is Qt.FocusReason.MouseFocusReason:
            QTimer.singleShot(0, self, self.selectAll)  # the click itself puts the cursor down yet
