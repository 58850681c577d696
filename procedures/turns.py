"""Several questions to one person, who is asked one after the other."""

from collections import deque

from tumble.procedures.operator import Answer, Operator
from tumble.procedures.steps import Ask


class Turns:
    """A person who is asked to set and read several positioners at once, and hears one question at a time.

    Parameters
    ----------
    operator
        The person.
    """

    def __init__(self, operator: Operator) -> None:
        self.operator = operator
        self.waiting: deque[Asker] = deque()
        """Who has a question, in the order in which they are asked; the first has been asked."""

    def asker(self) -> "Asker":
        """One more who has questions. Fits `Operator`."""
        return Asker(self)

    def put_next(self) -> None:
        """Ask the first question that is left."""
        if self.waiting:
            self.operator.ask_reading(self.waiting[0].prompt)


class Asker:
    """Asks in turn; see `Turns`. Fits `Operator` as far as readings are concerned."""

    def __init__(self, turns: Turns) -> None:
        self._turns = turns
        self.prompt = ""

    def ask(self, ask: Ask) -> None:
        """Conditions are asked for at a standstill, by the engine itself."""
        self._turns.operator.ask(ask)

    def ask_reading(self, prompt: str) -> None:
        """Ask now, or once the questions before are answered; a question takes the place of the one before it."""
        self.prompt = prompt
        waiting = self._turns.waiting
        if self not in waiting:
            waiting.append(self)
        if waiting[0] is self:
            self._turns.put_next()

    def poll(self) -> Answer | None:
        """The answer to one's own question, once it is there."""
        waiting = self._turns.waiting
        if not waiting or waiting[0] is not self or (answer := self._turns.operator.poll()) is None:
            return None
        waiting.popleft()
        self._turns.put_next()
        return answer

    def withdraw(self) -> None:
        """Have one's question asked no more; an answer that comes late is passed over with the next question."""
        if self in self._turns.waiting:
            self._turns.waiting.remove(self)
