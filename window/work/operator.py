"""The person in front of the window, as the engine sees them. Fits `tumble.procedures.operator.Operator`."""

from collections.abc import Callable
from functools import partial
from queue import Empty, SimpleQueue
from typing import Final

from PySide6.QtCore import QObject, Signal, Slot

from tumble.procedures.operator import Answer, understand, understand_reading
from tumble.procedures.steps import Ask

CONFIRMED: Final = "yes"
_BLINK_S: Final = 0.02


class WindowOperator(QObject):
    """Puts questions into the event loop, and what is answered there before the engine.

    Questions are numbered, and an answer belongs to the one that was on screen when it was given: where the engine asks
    for something else by then, it answers nothing.
    """

    condition_asked = Signal(object)
    """`Ask`: what is to be set."""
    reading_asked = Signal(str)
    """The prompt for a reading of the head; the setting came with the event before it."""

    _posted = Signal(int, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._answers: SimpleQueue[tuple[int, str]] = SimpleQueue()
        self._wanted: str | None = None
        self._asked = self._shown = 0
        """Number of the question that the engine put last, and of the one on screen."""
        self._posted.connect(self._show)

    def answer(self, text: str) -> None:
        """Answer the question that is on screen; called in the event loop."""
        self._answers.put((self._shown, text))

    def ask(self, ask: Ask) -> None:
        """Ask for what is to be set: the window has its own words, and a picture where the method has one."""
        self._put(ask.value, partial(self.condition_asked.emit, ask))

    def ask_reading(self, prompt: str) -> None:
        """Ask for a reading."""
        self._put(None, partial(self.reading_asked.emit, prompt))

    def poll(self) -> Answer | None:
        """The answer, if there is one within a blink: a stand that takes no time shall not spin meanwhile."""
        try:
            question, text = self._answers.get(timeout=_BLINK_S)
        except Empty:
            return None
        if question != self._asked:
            return None
        return understand_reading(text) if self._wanted is None else understand(text, self._wanted)

    def _put(self, wanted: str | None, show: Callable[[], None]) -> None:
        self._wanted = wanted
        self._asked += 1
        self._posted.emit(self._asked, show)

    @Slot(int, object)
    def _show(self, question: int, show: Callable[[], None]) -> None:
        self._shown = question
        show()
