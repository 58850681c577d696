"""Serve an emulated instrument to any client, over loopback TCP or a pseudo-terminal."""

import math
import time
from collections.abc import Callable
from contextlib import suppress
from threading import Event, Thread
from types import TracebackType
from typing import Final, Self

from tumble.emulators.faults import Faults
from tumble.emulators.ports import Channel, Port, PtyPort, TcpPort
from tumble.emulators.wire import Session, Wire

__all__ = ["Server", "Session", "serve_pty", "serve_tcp"]

POLL_S: Final = 0.003
"""Time between two looks at what an instrument wants to say unasked."""

BRISK_POLL_S: Final = 0.0003
BRISK_S: Final = 0.02
"""For so long after a client was heard, it is looked more often: an answer from another thread, as on CAN, is near."""

REOPEN_S: Final = 0.1
"""Time between two attempts to come back to a port that somebody else has taken."""

NOISE: Final = b"\xff\x00\x80t310\r< frame 31 >T1\r\a\xc0\xc1>\r\n"
"""What means nothing in any protocol here."""

LINE_ENDS: Final = b"\r\n"


class Server:
    """An instrument being served by a thread of its own, until it is closed.

    A client may leave and another come; each has a session of its own. The fault `drop` makes the port vanish for its
    `lasts_s`; what was answered but not yet sent is lost.
    """

    def __init__(
        self,
        session_factory: Callable[[], Session],
        port: Port,
        faults: Faults,
        terminators: bytes,
        whole: Callable[[bytes], bool] | None = None,
    ) -> None:
        self._session_factory = session_factory
        self._port = port
        self._faults = faults
        self._terminators, self._whole = terminators, whole
        self._wires: dict[Channel, Wire] = {}
        self._heard_s = -math.inf
        self._closing = Event()
        port.open()
        self._thread = Thread(target=self._serve, name=f"serving {port.url}", daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        """Where it is served, as pyserial wants it."""
        return self._port.url

    @property
    def port(self) -> int:
        """Number of the TCP port. Raises `AttributeError` for a terminal, which has none."""
        if not isinstance(self._port, TcpPort):
            raise AttributeError(f"{self.url} is no TCP port")
        return self._port.number

    def close(self) -> None:
        """Stop serving; returns when the thread has ended."""
        self._closing.set()
        self._thread.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _serve(self) -> None:
        while not self._closing.is_set():
            self._turn()
        self._port.close()

    def _turn(self) -> None:
        """Hear every client once, then answer, unless the link is lost meanwhile."""
        brisk = time.monotonic() - self._heard_s < BRISK_S
        answers = [(channel, self._heard(channel)) for channel in self._port.wait(BRISK_POLL_S if brisk else POLL_S)]
        if drop := self._faults.take("drop"):
            self._vanish(drop.lasts_s)
            return
        if self._faults.take("noise"):
            answers = [(channel, None if answer is None else NOISE + answer) for channel, answer in answers]
        for channel, answer in answers:
            if answer is None:
                self._port.leave(channel)
                self._wires.pop(channel, None)
            elif answer:
                channel.write(answer)

    def _heard(self, channel: Channel) -> bytes | None:
        """What goes to a client now; None where it is gone."""
        wire = self._wires.get(channel)
        if wire is None:
            wire = self._wires[channel] = Wire(self._session_factory(), self._faults, self._terminators, self._whole)
        data = channel.read()
        now_s = time.monotonic()
        if data:
            self._heard_s = now_s
        return None if data is None else wire.hear(data, now_s) + wire.due(now_s)

    def _vanish(self, lasts_s: float) -> None:
        self._port.close()
        self._wires.clear()
        pause_s = lasts_s
        while not self._closing.wait(pause_s):
            with suppress(OSError):  # somebody else has the port meanwhile
                self._port.open()
                return
            pause_s = REOPEN_S


def serve_tcp(
    session_factory: Callable[[], Session],
    port: int = 0,
    faults: Faults | None = None,
    terminators: bytes = LINE_ENDS,
    whole: Callable[[bytes], bool] | None = None,
) -> Server:
    """Serve over TCP on the loopback interface.

    Parameters
    ----------
    session_factory
        Called for every client that comes.
    port
        Number of the port; 0 for any that is free.
    faults
        What goes wrong on the wire.
    terminators
        Bytes, any of which ends a command.
    whole
        In a protocol without any: whether bytes are a whole command.

    Raises
    ------
    OSError
        The port is taken.
    """
    return Server(session_factory, TcpPort(port), faults or Faults(), terminators, whole)


def serve_pty(
    session_factory: Callable[[], Session], faults: Faults | None = None, terminators: bytes = LINE_ENDS
) -> Server:
    """Serve over a pseudo-terminal, in place of a serial port. Raises `OSError` on Windows, which has none."""
    return Server(session_factory, PtyPort(), faults or Faults(), terminators)
