"""The moment at which a window is on the screen for the first time."""

from PySide6.QtCore import QEvent, QObject, QTimer, Signal
from PySide6.QtGui import QWindow


class FirstPaint(QObject):
    """Waits until a window has been painted: what takes time and is not seen at once begins only then."""

    painted = Signal()

    def __init__(self, window: QWindow, parent: QObject) -> None:
        super().__init__(parent)
        window.installEventFilter(self)

    def eventFilter(self, window: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Tell of it once Qt has dealt with the event in which it paints the window for the first time."""
        if event.type() is QEvent.Type.Expose and isinstance(window, QWindow) and window.isExposed():
            window.removeEventFilter(self)
            QTimer.singleShot(0, self.painted.emit)
        return False
