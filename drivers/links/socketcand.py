"""A CAN bus of a socketcand server, in the raw mode of its protocol (https://github.com/linux-can/socketcand)."""

import re
import select
import socket
import time
from contextlib import suppress
from typing import Final

import can

from tumble.messages import Message

CONNECT_TIMEOUT_S: Final = 2.0
"""For the connection, each answer of the server, and whatever is sent."""
MOST_MESSAGE_BYTES: Final = 256
"""More without the end of a message is noise."""

_CHUNK_BYTES: Final = 4096
_FRAME: Final = re.compile(rb"< frame ([0-7][0-9A-F]{2}|[01][0-9A-F]{7}) ([0-9.]+) *((?:[0-9A-F]{2} ?){0,8}) *>", re.I)
_ERROR: Final = re.compile(rb"< error ([0-9A-F]{1,8}) [^<>]*>", re.I)
_ANSWERS: Final = (b"< hi >", b"< ok >", b"< echo >")


class SocketcandBus(can.BusABC):
    """The bus behind a server. Fits `can.BusABC`.

    `recv` raises `ValueError` for what is no message, and goes on with the next, and `ConnectionError` once the server
    has closed. python-can's own would read what it cannot understand for ever, take the end of the stream for silence,
    and wait without end for a server that does not greet.

    Raises
    ------
    OSError
        There is no server, or it does not let anybody on the bus.
    """

    def __init__(self, channel: str, host: str, port: int) -> None:
        self.channel_info = f"socketcand on {channel}@{host}:{port}"
        self._heard = bytearray()
        self._socket = socket.create_connection((host, int(port)), CONNECT_TIMEOUT_S)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            self._expect(b"< hi >")
            self._say(f"< open {channel} >")
            self._expect(b"< ok >")
            self._say("< rawmode >")
            self._expect(b"< ok >")
        except BaseException:
            self._socket.close()
            raise
        super().__init__(channel=channel)

    def send(self, msg: can.Message, timeout: float | None = None) -> None:  # noqa: ARG002  # the connection has its own
        """Send a data frame. Raises `OSError`."""
        can_id = f"{msg.arbitration_id:08X}" if msg.is_extended_id else f"{msg.arbitration_id:03X}"
        octets = "".join(f"{octet:x} " for octet in msg.data)
        self._say(f"< send {can_id} {len(msg.data)} {octets}>")

    def shutdown(self) -> None:
        """Leave the server."""
        super().shutdown()
        self._socket.close()

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        text = self._next(timeout)
        return (None if text is None else message_of(text)), False

    def _next(self, timeout: float | None) -> bytes | None:
        """The next message, from its `<` to its `>`; None where none is complete yet."""
        if b">" not in self._heard:
            self._listen(timeout)
        end = self._heard.find(b">") + 1
        if not end:
            return None
        start = max(self._heard.rfind(b"<", 0, end), 0)
        if junk := bytes(self._heard[:start]).strip():
            del self._heard[:start]
            raise ValueError(Message("{text!r} is no message", text=junk))
        text = bytes(self._heard[start:end])
        del self._heard[:end]
        return text

    def _listen(self, timeout: float | None) -> None:
        """Take what has come, and wait for it. Raises `ConnectionError` where the server has closed."""
        if not select.select([self._socket], [], [], timeout)[0]:
            return
        data = self._socket.recv(_CHUNK_BYTES)
        if not data:
            raise ConnectionAbortedError(Message("the server has closed the connection"))
        self._heard += data
        if len(self._heard) > MOST_MESSAGE_BYTES and b">" not in self._heard:
            self._heard.clear()
            raise ValueError(Message("{most} bytes without the end of a message", most=MOST_MESSAGE_BYTES))

    def _say(self, text: str) -> None:
        try:
            self._socket.sendall(text.encode())
        except TimeoutError as error:  # who knows how much of it has gone
            raise ConnectionAbortedError(Message("the server does not take what is sent")) from error

    def _expect(self, answer: bytes) -> None:
        deadline_s = time.monotonic() + CONNECT_TIMEOUT_S
        while time.monotonic() <= deadline_s:
            text = self._next(max(deadline_s - time.monotonic(), 0.0))
            if text == answer:
                return
            if text is not None:
                raise ConnectionRefusedError(
                    Message("the server answered {text!r}, where {answer!r} was expected", text=text, answer=answer)
                )
        raise TimeoutError(Message("the server gave no answer where {answer!r} was expected", answer=answer))


def message_of(text: bytes) -> can.Message | None:
    """The frame that a message tells; None where it tells of none. Raises `ValueError` for what is no message."""
    if frame := _FRAME.fullmatch(text):
        can_id, stamp, octets = frame.groups()
        moment_s = 0.0
        with suppress(ValueError):  # a time that is none: nobody here goes by it
            moment_s = float(stamp)
        data = bytes.fromhex(octets.decode("ascii"))
        return can.Message(
            arbitration_id=int(can_id, 16), is_extended_id=len(can_id) == 8, data=data, timestamp=moment_s
        )
    if error := _ERROR.fullmatch(text):
        return can.Message(arbitration_id=int(error[1], 16) & 0x1FFFFFFF, is_error_frame=True)
    if text in _ANSWERS:
        return None
    raise ValueError(Message("{text!r} is no message", text=text))
