"""The application: one window, its colours and its language, and what becomes of exceptions and signals."""

import gc
import os
import signal
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Final

from pyqtgraph.util.garbage_collector import GarbageCollector
from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QSessionManager
from PySide6.QtWidgets import QApplication

from tumble.window.faults import keep_details
from tumble.window.look.language import speak
from tumble.window.look.theme import dress, dress_window
from tumble.window.main_window import MainWindow
from tumble.window.painted import FirstPaint
from tumble.window.place import ScreenWatch, keep_on_screen
from tumble.window.preferences import language, shade, text_scale

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
        self._garbage = GarbageCollector()  # a widget is destroyed where the event loop is, whoever computes meanwhile
        self._application, self._store = application, store
        self._showing = False
        self.faulted.connect(self._show_fault)
        application.commitDataRequest.connect(self.end_session)
        self.window = self._made()

    def catch_faults(self) -> None:
        """Have every exception that nobody caught shown, and the head brought to rest."""

        def hook(_kind: type[BaseException], error: BaseException, _traceback: TracebackType | None) -> None:
            if isinstance(error, KeyboardInterrupt):
                self.window.leave()
            else:
                self.faulted.emit(error)

        sys.excepthook = hook
        threading.excepthook = lambda thrown: self.faulted.emit(thrown.exc_value)
        sys.unraisablehook = lambda thrown: self.faulted.emit(thrown.exc_value)

    def heed_signals(self, numbers: Sequence[int]) -> None:
        """Leave at a standstill where the system asks the program to end."""
        for number in numbers:
            signal.signal(number, lambda *_: self.window.leave())
        beat = QTimer(self, interval=_PYTHON_MS)
        beat.timeout.connect(lambda: None)  # Python handles signals between two of its instructions
        beat.start()

    def _dress(self) -> None:
        dress(self._application, shade(), text_scale())
        dress_window(self.window, text_scale())
        keep_on_screen(self.window)

    def end_session(self, manager: QSessionManager) -> None:
        """Bring the head to rest before the system ends the session; ask it to wait where that was not read back."""
        if not self.window.way_out.settle() and manager.allowsInteraction():
            manager.cancel()

    def _made(self) -> MainWindow:
        speak(language())
        dress(self._application, shade(), text_scale())
        window = MainWindow(self._store)
        dress_window(window, text_scale())
        window.dress_wanted.connect(self._dress)
        window.restart_wanted.connect(self._restart, Qt.ConnectionType.QueuedConnection)
        window.show()
        ScreenWatch(window)
        FirstPaint(window.windowHandle(), window).painted.connect(window.records.refresh)
        window.records.shown.connect(_keep_what_is_loaded, Qt.ConnectionType.SingleShotConnection)
        return window

    def _restart(self) -> None:
        """Make the window anew once this one is left: there are never two, and never two ways to one stand."""
        self._application.setQuitOnLastWindowClosed(False)
        self.window.left.connect(self._replace)
        self.window.worker.stuck.connect(self._keep)
        self.window.leave()

    def _keep(self, _error: BaseException) -> None:
        """The head may still move: the window stays, and is made anew another time."""
        self.window.left.disconnect(self._replace)
        self.window.worker.stuck.disconnect(self._keep)
        self._application.setQuitOnLastWindowClosed(True)

    def _replace(self) -> None:
        gc.unfreeze()  # what made the window before goes with it
        before, self.window = self.window, self._made()
        before.deleteLater()
        self._application.setQuitOnLastWindowClosed(True)

    def _show_fault(self, error: BaseException) -> None:
        if self._showing:  # showing a fault has a fault of its own: the log has to do
            keep_details(error)
            return
        self._showing = True
        try:
            self.window.fail(error)
        finally:
            self._showing = False


def _keep_what_is_loaded() -> None:
    """Look for garbage a last time in what the first list of records has had loaded: it stays, and is a great deal."""
    gc.collect()
    gc.freeze()


def application() -> QApplication:
    """The one `QApplication`, with the name under which settings are kept.

    It paints in its own thread alone: Qt shares every transparent line of a plot with threads of a pool, two hundred
    times each time a plot is painted, and waits for them, which takes ten times as long where others want the cores.
    """
    made = QApplication.instance()
    if made is None:
        gc.freeze()  # what was imported stays, and need not be looked at whenever garbage is collected
        os.environ.setdefault("QT_NO_GUI_THREADPOOL", "1")
        made = QApplication(sys.argv[:1])
    assert isinstance(made, QApplication), "another kind of application was made before"
    made.setOrganizationName("tumble")
    made.setApplicationName("tumble")
    return made


def show(store: Path) -> int:
    """Open the window, and return its exit status once it is closed."""
    from tumble.app.signals import STOPPING_SIGNALS

    qt = application()
    running = Application(qt, store)
    running.catch_faults()
    running.heed_signals(STOPPING_SIGNALS)
    return qt.exec()
