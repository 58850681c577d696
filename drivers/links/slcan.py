"""A serial CAN adapter (Lawicel's text protocol), whose lines may be cut, garbled, or of another kind than expected."""

import re
import time
from typing import Any, Final

import can
from can.interfaces.slcan import slcanBus

from tumble.messages import Message

MOST_LINE_BYTES: Final = 256
"""More without the end of a line is noise; the longest line, of CAN FD, has 138 bytes and a time stamp."""
LINE_ENDS: Final = re.compile(rb"[\r\a]")

_READ_S: Final = 0.05
"""One wait of the serial port for a byte."""
_FRAME: Final = re.compile(
    rb"(?:t([0-7][0-9A-F]{2})|[Tx]([01][0-9A-F]{7}))([0-8])((?:[0-9A-F]{2})*?)(?:[0-9A-F]{4}|[0-9A-F]{8})?", re.I
)
"""A data frame: identifier, length, bytes, and a time stamp where the adapter is set to give one."""
_REMOTE: Final = re.compile(rb"(?:r[0-7][0-9A-F]{2}|R[01][0-9A-F]{7})[0-8](?:[0-9A-F]{4}|[0-9A-F]{8})?", re.I)
_FD: Final = re.compile(rb"(?:[db][0-7][0-9A-F]{2}|[DB][01][0-9A-F]{7})[0-9A-F](?:[0-9A-F]{2})*", re.I)
_ANSWER: Final = re.compile(rb"[zZ]?|V[0-9A-F]*|N\w*|F[0-9A-F]{2}", re.I)
"""What an adapter says to a command; it needs no heeding."""


class SlcanBus(slcanBus):
    """The adapter as python-can opens and sets it. Fits `can.BusABC`.

    `recv` raises `ValueError` for a line that is no frame, and goes on with the next. python-can's own reader would
    raise `IndexError` there, take a cut frame for a whole one, and never get over a byte that is no text.
    """

    def __init__(self, channel: str, **options: Any) -> None:  # noqa: ANN401  # whatever the stand file says
        self._heard = bytearray()
        super().__init__(channel, **{"timeout": _READ_S} | options)

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        line = self._next_line(timeout)
        return (None if line is None else message_of(line)), False

    def _next_line(self, timeout: float | None) -> bytes | None:
        """The next line without its end; None where none has come in time."""
        deadline_s = None if timeout is None else time.monotonic() + timeout
        while not (end := LINE_ENDS.search(self._heard)):
            if len(self._heard) > MOST_LINE_BYTES:
                self._heard.clear()
                raise ValueError(Message("{most} bytes without the end of a line", most=MOST_LINE_BYTES))
            came = self.serialPortOrig.read(1)
            self._heard += came + self.serialPortOrig.read(self.serialPortOrig.in_waiting)
            if not came and deadline_s is not None and time.monotonic() > deadline_s:
                return None
        line = bytes(self._heard[: end.start()])
        del self._heard[: end.end()]
        return line


def message_of(line: bytes) -> can.Message | None:
    """The frame that a line tells; None where it tells of none. Raises `ValueError` for what is no line at all."""
    line = line.strip(b"\n")
    if frame := _FRAME.fullmatch(line):
        return _data_frame(line, *frame.groups())
    if _REMOTE.fullmatch(line):
        return can.Message(is_remote_frame=True)
    if _FD.fullmatch(line):
        return can.Message(is_fd=True)
    if _ANSWER.fullmatch(line):
        return None
    raise ValueError(Message("{line!r} is no frame", line=line))


def _data_frame(line: bytes, standard: bytes | None, extended: bytes | None, length: bytes, _: bytes) -> can.Message:
    digits = line[(4 if standard else 9) + 1 :]
    wanted = 2 * int(length)
    if len(digits) - wanted not in (0, 4, 8):
        raise ValueError(
            Message.counted(
                "{line!r} does not have the {count} byte that it says",
                "{line!r} does not have the {count} bytes that it says",
                line=line,
                count=int(length),
            )
        )
    return can.Message(
        arbitration_id=int(standard or extended or b"", 16),
        is_extended_id=standard is None,
        data=bytes.fromhex(digits[:wanted].decode("ascii")),
        timestamp=time.time(),
    )
