"""Where clients find an emulated instrument: a loopback TCP port, or a pseudo-terminal in place of a serial port."""

import os
import select
import socket
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Final, Protocol
from uuid import uuid4

from tumble.messages import Message

_CHUNK: Final = 4096
_WRITE_TIMEOUT_S: Final = 1.0
_MOST_CLIENTS: Final = 8


class Channel(Protocol):
    """The way to one client."""

    def read(self) -> bytes | None:
        """What has come from the client, possibly nothing; None where it is gone. Never waits."""
        ...

    def write(self, data: bytes) -> None:
        """Send to the client; what cannot be sent is lost."""
        ...


class Port(Protocol):
    """A place to which clients come."""

    @property
    def url(self) -> str:
        """How pyserial finds it."""
        ...

    def open(self) -> None:
        """Be there, under the same URL as ever."""
        ...

    def wait(self, timeout_s: float) -> list[Channel]:
        """Wait until something happens, at most so long; return the way to every client."""
        ...

    def leave(self, channel: Channel) -> None:
        """Forget a client that is gone."""
        ...

    def close(self) -> None:
        """Vanish; every client loses its connection."""
        ...


class TcpChannel:
    """A connected client. Fits `Channel`."""

    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self._lost = False
        connection.settimeout(_WRITE_TIMEOUT_S)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def read(self) -> bytes | None:
        """What has come; None after the end of the connection."""
        if self._lost:
            return None
        try:
            if not select.select([self.connection], [], [], 0.0)[0]:
                return b""
            return self.connection.recv(_CHUNK) or None
        except (OSError, ValueError):
            return None

    def write(self, data: bytes) -> None:
        """Send; a client that does not take it within a second is gone, since nobody knows how much it has of it."""
        try:
            self.connection.sendall(data)
        except OSError:
            self._lost = True


class TcpPort:
    """A listening socket on the loopback interface; several clients may come at a time. Fits `Port`."""

    def __init__(self, number: int) -> None:
        self.number = number
        """0 until it is open, where any free port will do."""
        self._listening: socket.socket | None = None
        self._channels: list[TcpChannel] = []

    @property
    def url(self) -> str:
        """`socket://127.0.0.1:PORT`."""
        return f"socket://127.0.0.1:{self.number}"

    def open(self) -> None:
        """Listen. Raises `OSError` where the port is taken."""
        listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            if sys.platform != "win32":  # there it would let two programs share the port
                listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listening.bind(("127.0.0.1", self.number))
            listening.listen(_MOST_CLIENTS)
        except OSError:
            listening.close()
            raise
        self.number = listening.getsockname()[1]
        self._listening = listening

    def wait(self, timeout_s: float) -> list[Channel]:
        """Wait for bytes or for a new client."""
        assert self._listening
        waited = [self._listening, *(channel.connection for channel in self._channels)]
        ready = select.select(waited, [], [], timeout_s)[0]
        if self._listening in ready:
            connection = self._listening.accept()[0]
            if len(self._channels) < _MOST_CLIENTS:
                self._channels.append(TcpChannel(connection))
            else:
                connection.close()
        return list(self._channels)

    def leave(self, channel: Channel) -> None:
        """Close the connection of one client."""
        for known in [known for known in self._channels if known is channel]:
            known.connection.close()
            self._channels.remove(known)

    def close(self) -> None:
        """Close every connection and listen no more."""
        for channel in list(self._channels):
            self.leave(channel)
        if self._listening:
            self._listening.close()
            self._listening = None


class PtyPort:
    """A pseudo-terminal under a name that stays when it vanishes and returns. Fits `Port`, and `Channel` too.

    Its slave side is held open, so that a client may leave and another come. POSIX only.
    """

    def __init__(self) -> None:
        self._name = Path(tempfile.gettempdir()) / f"tumble-{uuid4()}" / "tty"
        self._master = self._slave = -1

    @property
    def url(self) -> str:
        """Path of the terminal."""
        return str(self._name)

    def open(self) -> None:
        """Make the terminal, raw and without echo."""
        if sys.platform == "win32":
            raise OSError(Message("there are no pseudo-terminals on Windows; serve over TCP"))
        import tty  # not on Windows

        self._master, self._slave = os.openpty()
        self._name.parent.mkdir(mode=0o700)
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self._name.symlink_to(os.ttyname(self._slave))

    def wait(self, timeout_s: float) -> list[Channel]:
        """Wait for bytes."""
        select.select([self._master], [], [], timeout_s)
        return [self]

    def leave(self, channel: Channel) -> None:
        """A terminal has no connection that could end."""

    def read(self) -> bytes | None:
        """What has come, possibly nothing."""
        try:
            return os.read(self._master, _CHUNK)
        except OSError:
            return b""

    def write(self, data: bytes) -> None:
        """Send; what nobody reads is lost once the terminal's buffer is full."""
        with suppress(OSError):
            os.write(self._master, data)

    def close(self) -> None:
        """Hang up; a second call does nothing."""
        if self._master < 0:
            return
        self._name.unlink()
        self._name.parent.rmdir()
        for end in (self._master, self._slave):
            os.close(end)
        self._master = self._slave = -1
