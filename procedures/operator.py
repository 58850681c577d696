"""Asking the operator to seat the unit, without ever waiting for the answer in a way that a stop could not end.

An answer counts as yes only where it is the name of the mount or a word that says so: an empty line confirms nothing.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from typing import Final, Literal, Protocol, TextIO

from pydantic import BaseModel, ConfigDict

from procedures.toml_lines import load_toml

_YES: Final = frozenset({"yes", "done", "seated"})
_NO: Final = frozenset({"no", "abort", "cancel"})


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What the operator said, word for word, and whether it confirms the mount."""

    text: str
    confirmed: bool


class Operator(Protocol):
    """Who seats the unit."""

    def ask_mount(self, mount: str, prompt: str) -> None:
        """Put the request; returns at once."""
        ...

    def poll(self) -> Answer | None:
        """The answer, if there is one by now; never waits. A request that nobody will answer is not confirmed."""
        ...


def understand(text: str, mount: str) -> Answer | None:
    """What `text` says about seating the unit in `mount`; None where it says nothing clear."""
    word = text.strip().casefold()
    if word == mount.casefold() or word in _YES:
        return Answer(text=text.strip(), confirmed=True)
    if word in _NO:
        return Answer(text=text.strip(), confirmed=False)
    return None


class Answers(BaseModel):
    """An answers file, for runs that nobody attends.

    Its table `[mounts]` has `yes` or `no` by the name of the mount, and as `default` for mounts that it does not name:

        [mounts]
        default = "yes"
        end = "no"
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    mounts: dict[str, Literal["yes", "no"]] = {}

    def for_mount(self, mount: str) -> str:
        """`yes`, `no`, or nothing where the file does not say."""
        return self.mounts.get(mount, self.mounts.get("default", ""))


class ScriptedOperator:
    """Answers from an answers file; what the file does not say stays unanswered."""

    def __init__(self, answers: Answers) -> None:
        self._answers = answers
        self._answer: Answer | None = None

    @classmethod
    def from_file(cls, path: Path) -> "ScriptedOperator":
        """Read the answers from a TOML file. Raises `InputError`."""
        return cls(load_toml(path, Answers))

    def ask_mount(self, mount: str, prompt: str) -> None:  # noqa: ARG002  # nobody reads the prompt
        """Look the answer up."""
        text = self._answers.for_mount(mount)
        self._answer = Answer(text=text, confirmed=text == "yes")

    def poll(self) -> Answer | None:
        """The answer to the last request."""
        return self._answer


class ConsoleOperator:
    """Asks on a terminal.

    Lines are read from `lines` in a thread of their own, the only way to watch a terminal that works on Windows too.
    What was typed on a terminal before a request is no answer to it; lines from a file or a pipe are all taken, in
    order. At the end of the input a request stays unanswered.
    """

    def __init__(self, lines: TextIO, show: Callable[[str], None] = print) -> None:
        self._show = show
        self._mount = ""
        self._forget = lines.isatty()
        self._typed: Queue[str | None] = Queue(maxsize=100)
        self._at_end = False
        Thread(target=self._read, args=(lines,), name="console", daemon=True).start()

    def ask_mount(self, mount: str, prompt: str) -> None:
        """Show the prompt."""
        while self._forget and self._next_line() is not None:
            pass
        self._mount = mount
        self._show(prompt)

    def poll(self) -> Answer | None:
        """Look at the next line; one that says nothing clear is asked for again."""
        line = self._next_line()
        if line is None:
            return Answer(text="", confirmed=False) if self._at_end else None
        answer = understand(line, self._mount)
        if answer is None:
            self._show(f"Type {self._mount} or yes when the unit sits there, or no to end the run.")
        return answer

    def _next_line(self) -> str | None:
        try:
            line = self._typed.get_nowait()
        except Empty:
            return None
        self._at_end = line is None
        return line

    def _read(self, lines: TextIO) -> None:
        try:
            for line in lines:
                self._typed.put(line)
        finally:
            self._typed.put(None)


class SeatingOperator:
    """Has another operator answer and, once that one confirms, seats the unit of a simulated stand."""

    def __init__(self, operator: Operator, on_mount: Callable[[str], None]) -> None:
        self._operator = operator
        self._on_mount = on_mount
        self._mount = ""

    def ask_mount(self, mount: str, prompt: str) -> None:
        """Pass the request on."""
        self._mount = mount
        self._operator.ask_mount(mount, prompt)

    def poll(self) -> Answer | None:
        """Pass the answer on; a confirmed one seats the unit."""
        answer = self._operator.poll()
        if answer is not None and answer.confirmed:
            self._on_mount(self._mount)
        return answer
