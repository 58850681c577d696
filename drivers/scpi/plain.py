"""One query a message: what every SCPI instrument understands.

No message number and no redundancy come with it; both are made of messages one after the other:

- **Number.** `*ESE n`, then `*ESE?` until it is answered with n: all that was asked before has been answered, and what
  is still waiting is thrown away. After the questions `*ESE?` once more: an answer that is missing, doubled, late or
  merged with its neighbour has shifted the lines, and then it is not n. Numbers are made of the bits that every
  instrument keeps in the register (IEEE 488.2-1992, 11.5.1.1; two are reserved, and some instruments mask them).
  Where there is no such register, the identity is asked for in its place: it tells the order of answers, though not one
  request from another.
- **Redundancy.** Whatever is asked is asked twice, unless asking changes it.

So a line is believed under the same two conditions as in one message, at the price of some round trips.
"""

from collections.abc import Sequence
from itertools import cycle
from typing import Final

from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.protocols import Identity
from tumble.drivers.scpi.codec import (
    TERMINATOR,
    CorruptReplyError,
    QueueEntry,
    StaleReplyError,
    parse_error,
    parse_integer,
    parse_line,
    parse_name,
)
from tumble.drivers.scpi.exchange import Exchange, Link
from tumble.messages import Message

EVERYBODYS_BITS: Final = 0b10111101
"""Bits of the event register that IEEE 488.2 gives a meaning to which no multimeter leaves out."""


class PlainExchange(Exchange):
    """Message by message. Fits wherever an `Exchange` does."""

    def __init__(self, link: Link, device: str, timeout_s: float) -> None:
        super().__init__(link, device, timeout_s)
        self._tags = cycle(tag for tag in range(1, 256) if tag & EVERYBODYS_BITS == tag)
        self._numbered = False
        self._name = ""

    @property
    def asks_all_at_once(self) -> bool:
        """No."""
        return False

    def identify(self) -> Identity:
        """As `Exchange.identify`; from then on the order of answers is told by it, until they can be numbered."""
        self._numbered, self._name = False, ""
        return self._agreeing_identity(lambda: self._insist(self._asked_name))

    def number(self) -> bool:
        """Number the requests from now on, if the instrument keeps a number. Raises `LinkLostError`."""
        self._numbered = True
        try:
            self.ask()
        except LinkLostError:
            raise
        except DeviceError:
            self._numbered = False
        return self._numbered

    def ask(self, *queries: str, commands: Sequence[str] = (), extra_s: float = 0.0) -> tuple[str, ...]:
        """As `Exchange.ask`, message by message."""
        return self._insist(lambda number: self._attempt(queries * 2, commands, extra_s, again=number > 0))

    def ask_once(self, query: str, extra_s: float = 0.0, *, again: bool = False) -> str:
        """Ask what cannot be asked twice, and not again where the answer came to harm.

        Parameters
        ----------
        again
            Whether what was sent before may have been cut off.

        Raises
        ------
        NoReplyError
            There is no answer.
        CorruptReplyError
            It came to harm.
        """
        tag = next(self._tags)
        self._begin(tag, again)
        answer = self._answer(query, extra_s)
        self._check(tag, extra_s)
        return answer

    def next_error(self, *, again: bool = False) -> QueueEntry:
        """As `Exchange.next_error`."""
        return parse_error(self.ask_once("SYST:ERR?", again=again))

    def answers(self) -> bool:
        """Whether the instrument is there. Raises `LinkLostError`."""
        try:
            self._insist(lambda number: self._begin(next(self._tags), number > 0))
        except LinkLostError:
            raise
        except DeviceError:
            return False
        return True

    def _attempt(
        self, queries: Sequence[str], commands: Sequence[str], extra_s: float, *, again: bool
    ) -> tuple[str, ...]:
        tag = next(self._tags)
        self._begin(tag, again)
        for command in commands:
            self.say(command)
            self._check(tag)  # it has been read, and the next does not overrun a small buffer
        answers = tuple(self._answer(query, extra_s) for query in queries)
        self._check(tag, extra_s)
        half = len(answers) // 2
        if answers[:half] != answers[half:]:
            raise CorruptReplyError(Message("two copies of the same answer differ"))
        return answers[:half]

    def _answer(self, query: str, extra_s: float) -> str:
        self.say(query)
        return parse_line(self._link.read_line(TERMINATOR, self.timeout_s + extra_s))

    def _begin(self, tag: int, again: bool) -> None:
        """Have everything answered that was asked before; what may have been cut off is closed by a line end first."""
        if again:
            self._link.write(TERMINATOR)
        self._link.discard_input()
        if self._numbered:
            self.say(f"*ESE {tag}")
        self.say(self._mark)
        self._await(lambda line: self._passed(parse_line(line), tag), self.timeout_s)

    def _check(self, tag: int, extra_s: float = 0.0) -> None:
        """Make sure that no answer is missing or too many."""
        answer = self._answer(self._mark, extra_s)
        try:
            self._passed(answer, tag)
        except StaleReplyError as error:
            raise CorruptReplyError(
                Message("{answer!r} where the number of the request should be", answer=answer[:40])
            ) from error

    def _passed(self, answer: str, tag: int) -> None:
        """Raises `StaleReplyError` where a line is not that of the mark."""
        try:
            right = parse_integer(answer) == tag if self._numbered else answer == self._name
        except CorruptReplyError:
            right = False
        if not right:
            raise StaleReplyError(Message("{answer!r} answers something else", answer=answer[:40]))

    @property
    def _mark(self) -> str:
        return "*ESE?" if self._numbered else "*IDN?"

    def _asked_name(self, number: int) -> Identity:
        if number:
            self._link.write(TERMINATOR)
        self._link.discard_input()
        self._name = self._answer("*IDN?", 0.0)
        return parse_name(self._name)


def answered(exchange: Exchange, query: str) -> str | None:
    """The answer to a query; None where the instrument is there and has none.

    Raises `NoReplyError` where nothing is answered, `DeviceError` where nothing can be believed.
    """
    try:
        return exchange.ask(query)[0]
    except NoReplyError:
        if isinstance(exchange, PlainExchange) and exchange.answers():
            return None
        raise
