"""Asking the operator, without ever waiting for the answer in a way that a stop could not end.

What was asked for counts as done only where the answer is its name or a word that says so: an empty line confirms
nothing. Of a head that is set by hand any line is the reading, and an empty one says that it stands as asked.
"""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final, Literal, Protocol

from pydantic import BaseModel, ConfigDict, field_validator

from tumble.drivers.manual.reading import parse_reading
from tumble.messages import Message
from tumble.procedures.errors import UnansweredError
from tumble.procedures.steps import Ask
from tumble.procedures.toml_lines import load_toml
from tumble.procedures.typed import Typed

_YES: Final = frozenset({"yes", "done", "seated", "так", "готово", "ja", "fertig"})
_NO: Final = frozenset({"no", "abort", "cancel", "ні", "скасувати", "nein", "abbrechen"})
"""In every language of `tumble.messages.Language`."""


MOST_UNANSWERED_S: Final = 3600.0
"""How long a line through a pipe is waited for, in real time; at a terminal somebody may take any time."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What the operator said, word for word, and whether it confirms the request, or goes on with the reading."""

    text: str
    confirmed: bool


class Operator(Protocol):
    """Who sets what no positioner can, and sets and reads a head that has no motor."""

    def ask(self, ask: Ask) -> None:
        """Put the request; returns at once."""
        ...

    def ask_reading(self, prompt: str) -> None:
        """Ask for a setting of the head and its reading; returns at once."""
        ...

    def poll(self) -> Answer | None:
        """The answer, if there is one by now; never waits. A request that nobody will answer is not confirmed."""
        ...


def understand(text: str, value: str) -> Answer | None:
    """What `text` says to a request for `value`; None where it says nothing clear."""
    word = text.strip().casefold()
    if word == value.casefold() or word in _YES:
        return Answer(text=text.strip(), confirmed=True)
    if word in _NO:
        return Answer(text=text.strip(), confirmed=False)
    return None


def understand_reading(text: str) -> Answer:
    """What `text` says of a reading: a refusal, or what was read."""
    return Answer(text=text.strip(), confirmed=text.strip().casefold() not in _NO)


class Answers(BaseModel):
    """An answers file, for runs that nobody attends.

    Its table `[mounts]` has `yes` or `no` by the name of the mount, or of whatever else is asked for, and as `default`
    for what it does not name.
    Its table `[readings]` has what is typed when the head is to be set by hand, by the number of the question, from 1,
    and as `default`; nothing between the quotes is Enter alone:

        [mounts]
        default = "yes"
        end = "no"

        [readings]
        default = ""
        7 = "45 00 00"
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    mounts: dict[str, Literal["yes", "no"]] = {}
    readings: dict[str, str] = {}

    @field_validator("readings")
    @classmethod
    def _default_is_a_reading(cls, readings: dict[str, str]) -> dict[str, str]:
        """A default that is no reading would be asked for again for ever."""
        default = readings.get("default", "")
        if default and understand_reading(default).confirmed:
            try:
                parse_reading(default)
            except ValueError as error:
                raise ValueError(Message("default: {error}", error=error)) from error
        return readings

    def for_value(self, value: str) -> str:
        """`yes`, `no`, or nothing where the file does not say."""
        return self.mounts.get(value, self.mounts.get("default", ""))

    def for_reading(self, question: int) -> Answer:
        """What is typed at a question for a reading; refused where the file does not say."""
        text = self.readings.get(str(question), self.readings.get("default"))
        return Answer(text="", confirmed=False) if text is None else understand_reading(text)


class ScriptedOperator:
    """Answers from an answers file; what the file does not say stays unanswered."""

    def __init__(self, answers: Answers) -> None:
        self._answers = answers
        self._answer: Answer | None = None
        self._readings = 0

    @classmethod
    def from_file(cls, path: Path) -> "ScriptedOperator":
        """Read the answers from a TOML file. Raises `InputError`."""
        return cls(load_toml(path, Answers))

    def ask(self, ask: Ask) -> None:
        """Look the answer up."""
        text = self._answers.for_value(ask.value)
        self._answer = Answer(text=text, confirmed=text == "yes")

    def ask_reading(self, prompt: str) -> None:  # noqa: ARG002  # nobody reads the prompt
        """Look the answer up."""
        self._readings += 1
        self._answer = self._answers.for_reading(self._readings)

    def poll(self) -> Answer | None:
        """The answer to the last request."""
        return self._answer


class ConsoleOperator:
    """Asks on a terminal.

    What was typed on a terminal before a request is no answer to it; lines from a file or a pipe are all taken, in
    order. At the end of the input a request stays unanswered; so does one for which no line comes through a pipe within
    `MOST_UNANSWERED_S`, by `now_s`: nobody may be there to answer.
    """

    def __init__(
        self, typed: Typed, show: Callable[[str], None] = print, now_s: Callable[[], float] = time.monotonic
    ) -> None:
        self._show, self._now_s = show, now_s
        self._until_s = math.inf
        self._understand: Callable[[str], Answer | None] = understand_reading
        self._again = ""
        self._typed = typed
        typed.begin()

    def ask(self, ask: Ask) -> None:
        """Show the prompt."""
        self._understand = partial(understand, value=ask.value)
        self._again = ask.hint
        self._put(ask.prompt)

    def ask_reading(self, prompt: str) -> None:
        """Show the prompt."""
        self._understand = understand_reading
        self._put(prompt)

    def poll(self) -> Answer | None:
        """Look at the next line; one that says nothing clear is asked for again.

        Raises `UnansweredError` where lines cannot be read at all.
        """
        line = self._typed.next()
        if line is None and self._typed.at_end and self._typed.trouble:
            raise UnansweredError(
                Message(
                    "the answer could not be read ({trouble}); look at what is typed or piped, then resume the run",
                    trouble=self._typed.trouble,
                )
            )
        if line is None:
            unanswered = self._typed.at_end or self._now_s() > self._until_s
            return Answer(text="", confirmed=False) if unanswered else None
        self._wait_anew()
        answer = self._understand(line)
        if answer is None:
            self._show(self._again)
        return answer

    def _put(self, prompt: str) -> None:
        self._typed.forget()
        self._wait_anew()
        self._show(prompt)

    def _wait_anew(self) -> None:
        self._until_s = math.inf if self._typed.is_terminal else self._now_s() + MOST_UNANSWERED_S


class SeatingOperator:
    """Has another operator answer and, once that one confirms, sets the condition at a simulated stand.

    `setters` take what a condition shall be, by its name; others need nothing done.
    """

    def __init__(self, operator: Operator, setters: Mapping[str, Callable[[str], None]]) -> None:
        self._operator = operator
        self._setters = setters
        self._asked: Ask | None = None

    def ask(self, ask: Ask) -> None:
        """Pass the request on."""
        self._asked = ask
        self._operator.ask(ask)

    def ask_reading(self, prompt: str) -> None:
        """Pass the request on."""
        self._asked = None
        self._operator.ask_reading(prompt)

    def poll(self) -> Answer | None:
        """Pass the answer on; a confirmed one sets the condition."""
        answer = self._operator.poll()
        if (
            answer is not None
            and answer.confirmed
            and self._asked is not None
            and self._asked.condition in self._setters
        ):
            self._setters[self._asked.condition](self._asked.value)
        return answer
