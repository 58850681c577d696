"""Where the window is: as it was left, and wholly on a screen."""

from typing import Final

from PySide6.QtCore import QByteArray, QObject, QPoint, QRect, QSettings, QSize, QTimer
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import QMainWindow

from tumble.window.kept import kept_place

_SIZE: Final = QSize(1280, 800)
_FRAME: Final = QSize(16, 40)
"""What a window manager puts round a window, where it has not said so yet."""


def restore_place(window: QMainWindow, screens: int) -> int:
    """Give a window the place that it had, and return which of its screens was shown."""
    window.resize(_SIZE)
    geometry = QSettings().value("window/geometry")
    if isinstance(geometry, QByteArray):
        window.restoreGeometry(geometry)
    return kept_place("window/screen", 0, screens)


def remember_place(window: QMainWindow, number: int) -> None:
    """Keep both for the next time."""
    QSettings().setValue("window/geometry", window.saveGeometry())
    QSettings().setValue("window/screen", number)


def keep_on_screen(window: QMainWindow) -> None:
    """Make a window no larger than its screen has room for with a frame, and move it there."""
    if window.isMaximized() or window.isFullScreen():
        return
    room = window.screen().availableGeometry()
    told = window.frameGeometry().size() - window.size()
    frame = told if told.height() else _FRAME
    window.resize(window.size().boundedTo(room.size() - frame))
    window.move(_inside(QRect(window.pos(), window.size() + frame), room))


class ScreenWatch(QObject):
    """Keeps a window on its screen where that becomes smaller, or is taken away: STOP is on it.

    A window that is moved from screen to screen is left to whoever moves it.
    """

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self._window = window
        application = QGuiApplication.instance()
        assert isinstance(application, QGuiApplication), "a window has one"
        for screen in QGuiApplication.screens():
            self._watch(screen)
        application.screenAdded.connect(self._watch)
        application.screenRemoved.connect(self._keep)

    def _watch(self, screen: QScreen) -> None:
        screen.availableGeometryChanged.connect(self._keep)

    def _keep(self, _: object) -> None:
        QTimer.singleShot(0, self, lambda: keep_on_screen(self._window))  # the system has had its turn by then


def _inside(wanted: QRect, room: QRect) -> QPoint:
    left = max(room.left(), min(wanted.left(), room.right() + 1 - wanted.width()))
    top = max(room.top(), min(wanted.top(), room.bottom() + 1 - wanted.height()))
    return QPoint(left, top)
