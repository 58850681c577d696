"""The application: one window, its colours and its language, and what becomes of exceptions and signals."""

import signal
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Final

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QWindow
from PySide6.QtWidgets import QApplication

from window.look.language import speak
from window.look.theme import dress
from window.main_window import MainWindow
from window.menus import language, shade, text_scale

_TURN_S: Final = 5e-4
"""How long another thread may compute before the event loop has its turn; Python's own 5 ms are felt."""
_PYTHON_MS: Final = 200
"""How often the event loop lets Python see a signal of the system."""


class Application(QObject):
    """Keeps the window, and makes it anew in another language."""

    faulted = Signal(object)
    """An exception that nobody caught, from any thread."""

    def __init__(self, application: QApplication, store: Path) -> None:
        super().__init__(application)
        sys.setswitchinterval(_TURN_S)
        self._application, self._store = application, store
        self.faulted.connect(self._show_fault)
        application.focusWindowChanged.connect(self._watch_keys)
        self.window = self._made()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Esc stops the head from every window, a dialog that has the keyboard to itself included."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress and event.key() == Qt.Key.Key_Escape:
            self.window.worker.stop()
        return super().eventFilter(watched, event)

    def catch_faults(self) -> None:
        """Have every exception that nobody caught shown, and the head brought to rest."""

        def hook(_kind: type[BaseException], error: BaseException, _traceback: TracebackType | None) -> None:
            if isinstance(error, KeyboardInterrupt):
                self.window.leave()
            else:
                self.faulted.emit(error)

        sys.excepthook = hook
        threading.excepthook = lambda thrown: self.faulted.emit(thrown.exc_value)

    def heed_signals(self, numbers: Sequence[int]) -> None:
        """Leave at a standstill where the system asks the program to end."""
        for number in numbers:
            signal.signal(number, lambda *_: self.window.leave())
        beat = QTimer(self, interval=_PYTHON_MS)
        beat.timeout.connect(lambda: None)  # Python handles signals between two of its instructions
        beat.start()

    def _made(self) -> MainWindow:
        speak(language())
        dress(self._application, shade(), text_scale())
        window = MainWindow(self._store)
        window.dress_wanted.connect(lambda: dress(self._application, shade(), text_scale()))
        window.restart_wanted.connect(self._restart, Qt.ConnectionType.QueuedConnection)
        window.show()
        return window

    def _restart(self) -> None:
        before = self.window
        self._application.setQuitOnLastWindowClosed(False)
        before.close()
        self.window = self._made()
        before.deleteLater()
        self._application.setQuitOnLastWindowClosed(True)

    def _show_fault(self, error: BaseException) -> None:
        self.window.fail(error)

    def _watch_keys(self, window: QWindow | None) -> None:
        if window is not None and window is not self.window.windowHandle():
            window.installEventFilter(self)


def application() -> QApplication:
    """The one `QApplication`, with the name under which settings are kept."""
    made = QApplication.instance() or QApplication(sys.argv[:1])
    assert isinstance(made, QApplication), "another kind of application was made before"
    made.setOrganizationName("tumble")
    made.setApplicationName("tumble")
    return made


def show(store: Path) -> int:
    """Open the window, and return its exit status once it is closed."""
    from app.signals import STOPPING_SIGNALS

    qt = application()
    running = Application(qt, store)
    running.catch_faults()
    running.heed_signals(STOPPING_SIGNALS)
    return qt.exec()
