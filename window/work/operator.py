"""The person in front of the window, as the engine sees them. Fits `tumble.procedures.operator.Operator`."""

from queue import Empty, SimpleQueue
from typing import Final

from PySide6.QtCore import QObject, Signal

from tumble.procedures.operator import Answer, understand, understand_reading
from tumble.procedures.steps import Ask

CONFIRMED: Final = "yes"
_BLINK_S: Final = 0.02


class WindowOperator(QObject):
    """Puts questions into the event loop, and what is answered there before the engine.

    What was said before a question answers nothing.
    """

    condition_asked = Signal(object)
    """`Ask`: what is to be set."""
    reading_asked = Signal(str)
    """The prompt for a reading of the head; the setting came with the event before it."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._answers: SimpleQueue[str] = SimpleQueue()
        self._wanted: str | None = None

    def answer(self, text: str) -> None:
        """Answer the question that is open; called in the event loop."""
        self._answers.put(text)

    def ask(self, ask: Ask) -> None:
        """Ask for what is to be set: the window has its own words, and a picture where the method has one."""
        self._forget()
        self._wanted = ask.value
        self.condition_asked.emit(ask)

    def ask_reading(self, prompt: str) -> None:
        """Ask for a reading."""
        self._forget()
        self._wanted = None
        self.reading_asked.emit(prompt)

    def poll(self) -> Answer | None:
        """The answer, if there is one within a blink: a stand that takes no time shall not spin meanwhile."""
        try:
            text = self._answers.get(timeout=_BLINK_S)
        except Empty:
            return None
        return understand_reading(text) if self._wanted is None else understand(text, self._wanted)

    def _forget(self) -> None:
        while not self._answers.empty():
            self._answers.get_nowait()
