"""Closing the window: only once the head stands, and never unasked while anything goes on."""

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QObject

from tumble.window.look.language import tr
from tumble.window.widgets.dialog import QuestionDialog

if TYPE_CHECKING:
    from tumble.window.main_window import MainWindow

_WITHIN_S: Final = 15.0
"""How long the end of a session is put off for a standstill: as long as one may take, and what leaves a stand."""


class WayOut(QObject):
    """Stops what goes on, reads the standstill back, leaves the stand, and closes the window then.

    Where the standstill cannot be read back, the window stays and says so; it is left the next time that is wanted.
    """

    def __init__(self, window: "MainWindow") -> None:
        super().__init__(window)
        self._window = window
        self._leaving = self._clear = self._told = False
        window.worker.rested.connect(self._close)
        window.worker.connected.connect(self._forget)
        window.worker.stuck.connect(self._stay)

    def is_open(self) -> bool:
        """Whether the window may close now; where it may not yet, everything is done for that."""
        worker = self._window.worker
        if self._clear or self._told or not (self._window.busy or worker.session.is_connected):
            return True
        if self._window.busy and not self._leaving:
            self._ask()
        else:
            self.leave()
        return False

    def leave(self) -> None:
        """Close without asking."""
        if self._told or not (self._window.busy or self._window.worker.session.is_connected):
            self._close()
        elif not self._leaving:
            self._leaving = True
            self._window.worker.retire()

    def settle(self) -> bool:
        """Bring the head to rest before the system ends the session; false where it may still move."""
        return self._window.worker.settle(_WITHIN_S)

    def _close(self) -> None:
        self._clear = True
        self._window.close()

    def _forget(self, _identity: object) -> None:
        self._told = False

    def _stay(self, error: BaseException) -> None:
        self._leaving, self._told = False, True
        self._window.tell(error)

    def _ask(self) -> None:
        question = QuestionDialog(
            tr("Leave"),
            tr("The stand is at work. Stop it at a standstill, and leave? Complete points are kept."),
            tr("Stop and leave"),
        )
        question.agreed.connect(self.leave)
        self._window.dialogs.show_dialog(question)
