"""What happens between an emulated instrument and one client: commands in, answers out, and faults on the way."""

from collections.abc import Callable
from random import Random
from typing import Final, Protocol

from tumble.emulators.faults import WIRE, Fault, Faults

MOST_WAITING_BYTES: Final = 65536
"""A client that sends more than this without ending a command is not talking this protocol; it is thrown away."""


class Session(Protocol):
    """One client's conversation with an instrument. What must outlive the client belongs to the instrument."""

    def received(self, data: bytes) -> bytes:
        """Hear one command, its terminator included, and return what to answer at once, possibly nothing."""
        ...

    def due(self) -> bytes:
        """Return what to send unasked now, possibly nothing; called every few milliseconds."""
        ...


class Wire:
    """Cuts what a client sends into commands, and spoils answers as the faults say.

    A late answer does not hold up those behind it. A reordered one is sent right behind the next, or after its
    `lasts_s` where there is none. Bit errors are drawn from a fixed seed. A command ends with one of the terminators;
    in a protocol without any, `whole` says of bytes whether they are a whole one.
    """

    def __init__(
        self, session: Session, faults: Faults, terminators: bytes, whole: Callable[[bytes], bool] | None = None
    ) -> None:
        self._session = session
        self._faults = faults
        self._terminators = terminators
        self._whole = whole
        self._waiting = bytearray()
        self._later: list[tuple[float, bytes]] = []
        self._behind: tuple[float, bytes] | None = None
        self._random = Random(1)

    def hear(self, data: bytes, now_s: float) -> bytes:
        """Take what the client sent and return what goes to it at once."""
        answers = b""
        for octet in data:
            self._waiting.append(octet)
            if octet in self._terminators if self._whole is None else self._whole(bytes(self._waiting)):
                answers += self._answer(bytes(self._waiting), now_s)
                self._waiting.clear()
        if len(self._waiting) > MOST_WAITING_BYTES:
            self._waiting.clear()
        return answers

    def due(self, now_s: float) -> bytes:
        """Return what goes to the client without its having asked, late answers among it."""
        if self._behind and self._behind[0] <= now_s:
            self._later.append(self._behind)
            self._behind = None
        ripe = [answer for time_s, answer in self._later if time_s <= now_s]
        self._later = [entry for entry in self._later if entry[0] > now_s]
        return b"".join(ripe) + self._session.due()

    def _answer(self, command: bytes, now_s: float) -> bytes:
        if not command.strip(self._terminators):
            return self._session.received(command)
        self._faults.note_command(command)
        answer = self._session.received(command)
        fault = self._faults.take(*WIRE) if answer else None
        if fault:
            return self._spoilt(answer, fault, now_s)
        return answer + self._held_back() if answer else b""

    def _held_back(self) -> bytes:
        """The answer that was to come behind the next one."""
        held, self._behind = self._behind, None
        return held[1] if held else b""

    def _spoilt(self, answer: bytes, fault: Fault, now_s: float) -> bytes:
        entry = now_s + fault.lasts_s, answer
        if fault.kind == "late":
            self._later.append(entry)
            return b""
        if fault.kind == "reorder":
            overtaken, self._behind = self._held_back(), entry
            return overtaken
        return spoilt(answer, fault.kind, self._random)


def spoilt(text: bytes, kind: str, random: Random) -> bytes:
    """Text after a fault of the kind `cut`, `double`, `garble` or `wrong_checksum`."""
    return _SPOILS[kind](text, random)


def _cut(answer: bytes, _: Random) -> bytes:
    return answer[: len(answer) // 2]


def _doubled(answer: bytes, _: Random) -> bytes:
    return answer * 2


def _garbled(answer: bytes, random: Random) -> bytes:
    """One wrong bit in the text, so that the end of the line stays where it is."""
    place = random.randrange(max(len(answer.rstrip()), 1))
    spoilt = answer[place] ^ 1 << random.randrange(7)
    return answer[:place] + bytes([spoilt]) + answer[place + 1 :]


def _with_wrong_checksum(answer: bytes, _: Random) -> bytes:
    """The last digit of the text is another one."""
    text = answer.rstrip()
    other = b"1" if text[-1:] == b"0" else b"0"
    return text[:-1] + other + answer[len(text) :]


_SPOILS: Final[dict[str, Callable[[bytes, Random], bytes]]] = {
    "cut": _cut,
    "double": _doubled,
    "garble": _garbled,
    "wrong_checksum": _with_wrong_checksum,
}
