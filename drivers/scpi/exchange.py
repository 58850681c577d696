"""Questions to a SCPI instrument whose answers can be believed."""

from collections.abc import Callable, Sequence
from itertools import cycle
from typing import Final, Protocol, TypeVar

from drivers.errors import DeviceError, NoReplyError
from drivers.protocols import Identity
from drivers.scpi.codec import (
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

ATTEMPTS: Final = 3
LONGEST_QUEUE: Final = 50
"""An error queue that does not end after so many entries is no error queue."""
MOST_STALE: Final = 8
"""More answers to earlier requests than this cannot be on their way."""

Answer = TypeVar("Answer")


class Link(Protocol):
    """The way to the instrument; `drivers.links.SerialLink` is one."""

    def write(self, data: bytes) -> None:
        """Send bytes."""
        ...

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait for a line. Raises `NoReplyError`."""
        ...

    def discard_input(self) -> None:
        """Throw away what has come. Raises `NoReplyError` where it does not end."""
        ...


class Exchange:
    """Sends commands and queries, numbered and doubled as `codec` describes, until an answer can be believed.

    Everything sent through it may be sent again, because a command here only configures, or begins a measurement that
    takes the place of the one before. A line that answers an earlier request is passed over. Anything else that is not
    the answer is followed by another attempt, with another number, after a line end that closes what may have arrived
    of the last one.
    """

    def __init__(self, link: Link, device: str, timeout_s: float) -> None:
        self._link = link
        self._device = device
        self._timeout_s = timeout_s
        self._tags = cycle(range(1, TAGS))

    def ask(self, *queries: str, commands: Sequence[str] = (), extra_s: float = 0.0) -> tuple[str, ...]:
        """Carry out `commands`, then answer `queries`.

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
        return self._insist(
            lambda tag: request(tag, commands, queries * 2),
            lambda line, tag: agreed(parse_reply(line, tag, 2 * len(queries))),
            self._timeout_s + extra_s,
        )

    def identify(self) -> Identity:
        """Ask for the identity until two answers in a row agree. Raises as `ask`."""
        previous = None
        for _ in range(ATTEMPTS):
            current = self._insist(identity_request, parse_identity, self._timeout_s)
            if current == previous:
                return current
            previous = current
        raise self._unbelievable("its identity is another one every time")

    def errors(self) -> list[QueueEntry]:
        """Empty the error queue. Raises as `ask`."""
        entries: list[QueueEntry] = []
        while len(entries) < LONGEST_QUEUE:
            entry = self._insist(
                lambda tag: request(tag, (), ("SYST:ERR?",)),
                lambda line, tag: parse_error(*parse_reply(line, tag, 1)),
                self._timeout_s,
            )
            if entry.number == 0:
                return entries
            entries.append(entry)
        raise self._unbelievable("its error queue has no end")

    def _insist(self, write: Callable[[int], bytes], read: Callable[[bytes, int], Answer], timeout_s: float) -> Answer:
        failure: Exception | None = None
        for attempt in range(ATTEMPTS):
            tag = next(self._tags)
            self._link.discard_input()
            self._link.write((TERMINATOR if attempt else b"") + write(tag))
            try:
                return self._await(read, tag, timeout_s)
            except (NoReplyError, CorruptReplyError) as error:
                failure = error
        if isinstance(failure, NoReplyError):
            raise failure
        raise self._unbelievable(str(failure))

    def _await(self, read: Callable[[bytes, int], Answer], tag: int, timeout_s: float) -> Answer:
        for _ in range(MOST_STALE):
            line = self._link.read_line(TERMINATOR, timeout_s)
            try:
                return read(line, tag)
            except StaleReplyError:
                continue
        raise CorruptReplyError("nothing but answers to earlier requests")

    def _unbelievable(self, why: str) -> DeviceError:
        return DeviceError(
            self._device,
            f"gave no answer that can be believed in {ATTEMPTS} attempts ({why})",
            "check cable, earth and baud rate, and that nobody else talks to it",
        )
