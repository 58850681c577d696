"""Lines of bytes over any pyserial URL, with the two ways of failing told apart."""

import select
import socket
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import Final

import serial

from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.links.opening import opened_unless_stopped
from tumble.drivers.links.patience import in_words, is_passing, patiently
from tumble.messages import Message

WRITE_TIMEOUT_S: Final = 2.0
MOST_LINE_BYTES: Final = 1 << 20
"""A line longer than this is noise."""
MOST_STALE_BYTES: Final = 4 * MOST_LINE_BYTES
"""More than some answers that nobody waited for."""
DISCARD_S: Final = 1.0
"""A line that does not fall silent for so long is not one that was asked."""

FAILING_S: Final = 1.0
"""How long a port may fail in passing, in real time."""

RECONNECT_S: Final = 0.3
"""A server is given so long to notice that a client has gone before the next comes, as pyserial has it."""

_CHUNK_BYTES: Final = 1 << 16
_SLICE_S: Final = 0.05
"""One wait inside pyserial. It stays as it is, since pyserial sets the whole port anew whenever it is changed."""

_hung_up_s: Final[dict[str, float]] = {}
"""When this program last left each address of a network, by `time.monotonic`."""


class SerialLink:
    """A serial port, `socket://HOST:PORT`, `rfc2217://HOST:PORT`, or the path of a terminal.

    A port is had by one program at a time.

    Every failure of the port is a `LinkLostError`, and the port is then closed: only `reopen` makes it usable again.
    What came after the end of a line is kept for the next `read_line`.

    Parameters
    ----------
    url
        Any pyserial URL or port name.
    baud_rate
        Of a real port; what is reached over a network does not care.
    device
        What errors call the instrument at the other end.
    check
        Called many times a second while a line is awaited, or what has come is thrown away; what it raises breaks
        that off.
    check_opening
        The same while the port is opened, whenever that is.

    Raises
    ------
    LinkLostError
        The port cannot be opened.
    """

    def __init__(
        self,
        url: str,
        baud_rate: int = 115_200,
        device: str = "instrument",
        check: Callable[[], object] = lambda: None,
        check_opening: Callable[[], object] = lambda: None,
    ) -> None:
        self.url = url
        self._check, self._check_opening = check, check_opening
        self.device = device
        self._baud_rate = baud_rate
        self._is_socket = url.startswith("socket://")
        self._waiting = bytearray()
        self._port: serial.Serial | None = None
        self.reopen()

    @property
    def checksummed(self) -> bool:
        """Whether what is underneath notices garbled bytes: TCP to the instrument itself; not a serial line."""
        return self._is_socket

    def write(self, data: bytes) -> None:
        """Send bytes. Raises `LinkLostError`, also where the other end does not take them in time."""
        with self._watched() as port:
            patiently(lambda: port.write(data), WRITE_TIMEOUT_S, is_passing)

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait for a line and return it with its terminator.

        Raises
        ------
        NoReplyError
            None was complete within `timeout_s` real seconds, and what came of it stays for the next call; or noise
            came without the end of a line.
        LinkLostError
            The port is gone.

        And whatever `check` raises: what came of the line stays for the next call then, too.
        """
        deadline_s = time.monotonic() + timeout_s
        while terminator not in self._waiting:
            self._check()
            if time.monotonic() > deadline_s:
                raise NoReplyError(
                    self.device,
                    Message("gave no answer at {url} within {timeout_s:g} s", url=self.url, timeout_s=timeout_s),
                    Message("check that it is switched on and that address and baud rate are right"),
                )
            self._receive()
            if len(self._waiting) > MOST_LINE_BYTES and terminator not in self._waiting:
                self._waiting.clear()
                raise self._chatters(
                    Message(
                        "sent {most} bytes at {url} without the end of a line",
                        most=MOST_LINE_BYTES,
                        url=self.url,
                    )
                )
        end = self._waiting.index(terminator) + len(terminator)
        line = bytes(self._waiting[:end])
        del self._waiting[:end]
        return line

    def discard_input(self) -> None:
        """Throw away everything that has come so far.

        Raises
        ------
        NoReplyError
            It does not end: somebody sends without pause.
        LinkLostError
            The port is gone.
        """
        self._waiting.clear()
        thrown_away, deadline_s = 0, time.monotonic() + DISCARD_S
        while came := self._drained():
            thrown_away += came
            if thrown_away > MOST_STALE_BYTES or time.monotonic() > deadline_s:
                raise self._chatters(Message("sends without pause at {url}", url=self.url))

    def reopen(self) -> None:
        """Close and open the port anew, with nothing waiting.

        Raises `LinkLostError` while it is not there, and whatever `check_opening` raises: the port is closed then.
        """
        self.close()
        self._let_server_notice()
        self._port = opened_unless_stopped(self._opened, self._check_opening, lambda port: port.close(), self.url)

    def _opened(self) -> serial.Serial:
        """A port at the address. Raises `LinkLostError`."""
        telnet = self.url.startswith("rfc2217://")  # pyserial offers no write timeout there
        open_port = partial(
            serial.serial_for_url,
            self.url,
            baudrate=self._baud_rate,
            timeout=0.0 if self._is_socket else _SLICE_S,
            write_timeout=None if telnet else WRITE_TIMEOUT_S,
            exclusive=True,
        )
        try:
            port: serial.Serial = patiently(open_port, FAILING_S, _is_passing_at_opening)
            _send_at_once(port)
        except Exception as error:  # pyserial lets through what the system's terminals raise
            raise LinkLostError(
                self.device,
                Message("cannot be reached at {url} ({reason})", url=self.url, reason=in_words(error)),
                Message("check cable, power and port, and the url in the stand file"),
            ) from error
        return port

    def close(self) -> None:
        """Close the port; a closed one stays closed."""
        port, self._port = self._port, None
        self._waiting.clear()
        if port is None:
            return
        connection = getattr(port, "_socket", None)
        if self._is_socket and connection is not None:
            _hang_up(connection)
            port.is_open = False  # pyserial's way waits for the server whether anybody comes back or not
            _hung_up_s[self.url] = time.monotonic()
        with suppress(Exception):  # what is lost cannot be closed properly
            port.close()
        if connection is not None:  # pyserial forgets one that the other end has shut down
            connection.close()

    def _let_server_notice(self) -> None:
        """Wait where this address was left a moment ago."""
        left_s = _hung_up_s.pop(self.url, None)
        if left_s is not None:
            time.sleep(max(left_s + RECONNECT_S - time.monotonic(), 0.0))

    def _drained(self) -> int:
        """Throw a piece of what has come away; returns its length, none where nothing waits."""
        self._check()
        with self._watched() as port:
            return patiently(lambda: len(self._piece(port)), FAILING_S, is_passing)

    def _piece(self, port: serial.Serial) -> bytes:
        waiting: int = port.in_waiting
        piece: bytes = port.read(_CHUNK_BYTES if self._is_socket else waiting) if waiting else b""
        return piece

    def _receive(self) -> None:
        """Take what has come; wait a moment for the first byte."""
        with self._watched() as port:
            patiently(lambda: self._take(port), FAILING_S, is_passing)

    def _take(self, port: serial.Serial) -> None:
        if self._is_socket:  # there, pyserial knows only whether anything waits, not how much
            if select.select([port.fileno()], [], [], _SLICE_S)[0]:
                self._waiting += port.read(_CHUNK_BYTES)
        else:
            self._waiting += port.read(1)
            self._waiting += port.read(port.in_waiting)

    @contextmanager
    def _watched(self) -> Iterator[serial.Serial]:
        """The open port; whatever fails there closes it and is told as a lost link."""
        if self._port is None:
            raise self._lost(Message("the port is closed"))
        try:
            yield self._port
        except DeviceError:
            raise
        except Exception as error:  # pyserial lets through what the system's terminals raise
            self.close()
            raise self._lost(in_words(error)) from error

    def _chatters(self, how: str) -> NoReplyError:
        return NoReplyError(
            self.device,
            Message("{how}, unasked", how=how),
            Message("check the baud rate, and that nothing else talks on this line"),
        )

    def _lost(self, why: str) -> LinkLostError:
        return LinkLostError(
            self.device,
            Message("the link at {url} is lost ({why})", url=self.url, why=why),
            Message("check cable and power; the run can be resumed"),
        )


def _is_passing_at_opening(error: Exception) -> bool:
    """Whether a port may be there a moment later; one that another program has will not, though pyserial says so."""
    return is_passing(error) and not isinstance(error, serial.SerialException)


def _hang_up(connection: socket.socket) -> None:
    with suppress(OSError):  # the other end has hung up before
        connection.shutdown(socket.SHUT_RDWR)
    connection.close()


def _send_at_once(port: serial.Serial) -> None:
    """Keep the network from holding back a short message until the one before is acknowledged, 40 ms later."""
    connection = getattr(port, "_socket", None)
    if connection is not None:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
