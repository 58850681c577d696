"""A button that starts motion."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QPushButton, QWidget


class MotionButton(QPushButton):
    """Pressed by the mouse or by its own function key, and by nothing that a barcode scanner can type.

    It takes no focus, so that neither Enter nor a space ever presses it.
    """

    def __init__(self, text: str, key: str, parent: QWidget | None = None) -> None:
        sequence = QKeySequence(key)
        super().__init__(f"{text}  [{sequence.toString(QKeySequence.SequenceFormat.NativeText)}]", parent)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAutoDefault(False)
        self.setShortcut(sequence)
        self.setAccessibleName(text)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Leave every key to others: the function key comes as a shortcut."""
        event.ignore()
