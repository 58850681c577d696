"""Questions to a SCPI instrument whose answers can be believed."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from itertools import cycle
from typing import Final, Protocol, TypeVar

from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.protocols import Identity
from tumble.drivers.scpi.codec import (
    TAGS,
    TERMINATOR,
    CorruptReplyError,
    QueueEntry,
    StaleReplyError,
    agreed,
    identity_request,
    parse_error,
    parse_identity,
    parse_reply,
    request,
)
from tumble.messages import Message

ATTEMPTS: Final = 3
LONGEST_QUEUE: Final = 50
"""An error queue that does not end after so many entries is no error queue."""
MOST_STALE: Final = 8
"""More answers to earlier requests than this cannot be on their way."""
ENTRY_LOST: Final = QueueEntry(
    number=-1, text=Message("an answer of the error queue came to harm, and what it said is lost")
)

Answer = TypeVar("Answer")


class Link(Protocol):
    """The way to the instrument; `tumble.drivers.links.SerialLink` is one."""

    @property
    def checksummed(self) -> bool:
        """Whether what is underneath notices and mends garbled bytes, as TCP does and a serial line does not."""
        ...

    def write(self, data: bytes) -> None:
        """Send bytes."""
        ...

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait for a line. Raises `NoReplyError`."""
        ...

    def discard_input(self) -> None:
        """Throw away what has come. Raises `NoReplyError` where it does not end."""
        ...


class Exchange(ABC):
    """Sends commands and queries until an answer can be believed; how they go over the wire is up to the kind.

    Everything sent through it may be sent again, because a command here only configures, or begins a measurement that
    takes the place of the one before. A line that answers an earlier request is passed over. Anything else that is not
    the answer is followed by another attempt, with another number, after a line end that closes what may have arrived
    of the last one.
    """

    def __init__(self, link: Link, device: str, timeout_s: float) -> None:
        self.timeout_s = timeout_s
        self.patience = ATTEMPTS
        """How often it may be silent before it is given up; less often while it is tried what it answers."""
        self.has_error_queue = True
        """Whether it can be asked for errors; where it cannot, there are none."""
        self._link = link
        self._device = device

    @property
    @abstractmethod
    def asks_all_at_once(self) -> bool:
        """Whether any number of commands and queries may go in one message."""

    @abstractmethod
    def ask(self, *queries: str, commands: Sequence[str] = (), extra_s: float = 0.0) -> tuple[str, ...]:
        """Carry out `commands`, then answer `queries`, each of which is asked twice.

        Parameters
        ----------
        queries
            None of them `*IDN?` or `*OPT?`.
        commands
            What to do first.
        extra_s
            How much longer than usual the answer may take, in real seconds.

        Raises
        ------
        NoReplyError
            No answer to the last of `ATTEMPTS` attempts.
        DeviceError
            No answer that can be believed.
        """

    @abstractmethod
    def identify(self) -> Identity:
        """Ask for the identity until two answers in a row agree. Raises as `ask`."""

    @abstractmethod
    def next_error(self, *, again: bool = False) -> QueueEntry:
        """Ask once for the oldest entry of the error queue, which is gone with that.

        Parameters
        ----------
        again
            Whether what was sent before may have been cut off.

        Raises `NoReplyError`, and `CorruptReplyError` or `StaleReplyError` where the answer came to harm.
        """

    def say(self, *commands: str) -> None:
        """Send commands, each as a message of its own, and wait for nothing."""
        for command in commands:
            self._link.write(command.encode("ascii") + TERMINATOR)

    def errors(self) -> list[QueueEntry]:
        """Empty the error queue. An entry whose answer came to harm is an error, too, since nobody knows what it said.

        Raises as `ask`.
        """
        if not self.has_error_queue:
            return []
        entries: list[QueueEntry] = []
        lost = 0
        while len(entries) < LONGEST_QUEUE:
            try:
                entry = self.next_error(again=lost > 0)
            except (NoReplyError, CorruptReplyError, StaleReplyError) as error:
                lost += 1
                if lost < (self.patience if isinstance(error, NoReplyError) else ATTEMPTS):
                    continue
                raise self._given_up(error) from error
            if entry.number == 0:
                return entries + [ENTRY_LOST] * bool(lost)
            entries.append(entry)
        raise self._unbelievable(Message("its error queue has no end"))

    def _await(self, read: Callable[[bytes], Answer], timeout_s: float) -> Answer:
        """The first line that answers no earlier request."""
        for _ in range(MOST_STALE):
            line = self._link.read_line(TERMINATOR, timeout_s)
            try:
                return read(line)
            except StaleReplyError:
                continue
        raise CorruptReplyError(Message("nothing but answers to earlier requests"))

    def _given_up(self, failure: Exception) -> DeviceError:
        return failure if isinstance(failure, NoReplyError) else self._unbelievable(str(failure))

    def _unbelievable(self, why: str) -> DeviceError:
        return DeviceError(
            self._device,
            Message("gave no answer that can be believed in {attempts} attempts ({why})", attempts=ATTEMPTS, why=why),
            Message("check cable, earth and baud rate, and that nobody else talks to it"),
        )

    def _insist(self, attempt: Callable[[int], Answer]) -> Answer:
        """Try up to `ATTEMPTS` times; the attempt is told its number."""
        failure: Exception = CorruptReplyError(Message("it was not asked"))
        silences = 0
        for number in range(ATTEMPTS):
            try:
                return attempt(number)
            except (NoReplyError, CorruptReplyError) as error:
                failure = error
                silences += isinstance(error, NoReplyError)
                if silences >= self.patience:
                    break
        raise self._given_up(failure)

    def _agreeing_identity(self, ask: Callable[[], Identity]) -> Identity:
        """Ask until two answers in a row agree."""
        previous = None
        for _ in range(ATTEMPTS):
            current = ask()
            if current == previous:
                return current
            previous = current
        raise self._unbelievable(Message("its identity is another one every time"))


class CompoundExchange(Exchange):
    """Everything in one message, numbered and doubled as `codec` describes."""

    def __init__(self, link: Link, device: str, timeout_s: float) -> None:
        super().__init__(link, device, timeout_s)
        self._tags = cycle(range(1, TAGS))

    @property
    def asks_all_at_once(self) -> bool:
        """Yes."""
        return True

    def ask(self, *queries: str, commands: Sequence[str] = (), extra_s: float = 0.0) -> tuple[str, ...]:
        """As `Exchange.ask`, in one message."""
        return self._insist(
            lambda number: self._round(
                lambda tag: request(tag, commands, queries * 2),
                lambda line, tag: agreed(parse_reply(line, tag, 2 * len(queries))),
                extra_s,
                again=number > 0,
            )
        )

    def identify(self) -> Identity:
        """As `Exchange.identify`."""
        return self._agreeing_identity(
            lambda: self._insist(lambda number: self._round(identity_request, parse_identity, again=number > 0))
        )

    def next_error(self, *, again: bool = False) -> QueueEntry:
        """As `Exchange.next_error`."""
        return self._round(
            lambda tag: request(tag, (), ("SYST:ERR?",)),
            lambda line, tag: parse_error(*parse_reply(line, tag, 1)),
            again=again,
        )

    def _round(
        self,
        write: Callable[[int], bytes],
        read: Callable[[bytes, int], Answer],
        extra_s: float = 0.0,
        *,
        again: bool,
    ) -> Answer:
        tag = next(self._tags)
        self._link.discard_input()
        self._link.write((TERMINATOR if again else b"") + write(tag))
        return self._await(lambda line: read(line, tag), self.timeout_s + extra_s)
