"""Closing the window: only once the head stands, and never unasked while anything goes on."""

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QObject, Signal

from tumble.window.look.language import tr
from tumble.window.widgets.dialog import QuestionDialog
from tumble.window.work.stand_worker import StandWorker

_WITHIN_S: Final = 15.0
"""How long the end of a session is put off for a standstill: as long as one may take, and what leaves a stand."""


class WayOut(QObject):
    """Stops what goes on, reads the standstill back, leaves the stand, and closes the window then.

    Where the standstill cannot be read back, the window stays and says so; it is left the next time that is wanted.
    """

    clear = Signal()
    """Nothing is in the way any more."""
    dialog_wanted = Signal(object)
    """`Dialog`."""
    refused = Signal(object)
    """The exception for which the standstill was not read back."""

    def __init__(self, worker: StandWorker, busy: Callable[[], bool], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._worker, self._busy = worker, busy
        self._leaving = self._clear = self._told = False
        worker.rested.connect(self._close)
        worker.connected.connect(self._forget)
        worker.stuck.connect(self._stay)

    def is_open(self) -> bool:
        """Whether the window may close now; where it may not yet, everything is done for that."""
        if self._clear or self._told or not self._in_use:
            return True
        if self._busy() and not self._leaving:
            self._ask()
        else:
            self.leave()
        return False

    def leave(self) -> None:
        """Close without asking."""
        if self._told or not self._in_use:
            self._close()
        elif not self._leaving:
            self._leaving = True
            self._worker.retire()

    def settle(self) -> bool:
        """Bring the head to rest before the system ends the session; false where it may still move."""
        return self._worker.settle(_WITHIN_S)

    def _close(self) -> None:
        self._clear = True
        self.clear.emit()

    @property
    def _in_use(self) -> bool:
        return self._busy() or self._worker.session.is_connected

    def _forget(self, _identity: object) -> None:
        self._told = False

    def _stay(self, error: BaseException) -> None:
        self._leaving, self._told = False, True
        self.refused.emit(error)

    def _ask(self) -> None:
        question = QuestionDialog(
            tr("Leave"),
            tr("The stand is at work. Stop it at a standstill, and leave? Complete points are kept."),
            tr("Stop and leave"),
        )
        question.agreed.connect(self.leave)
        self.dialog_wanted.emit(question)
