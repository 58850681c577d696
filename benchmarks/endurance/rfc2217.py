"""A network port server after RFC 2217, pyserial's own, in front of another port."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Thread

import serial
from serial.rfc2217 import PortManager


@contextmanager
def rfc2217_port(url: str) -> Iterator[str]:
    """Serve what is reached at `url` to one client; gives the URL where it comes."""
    listening = socket.create_server(("127.0.0.1", 0))
    port = serial.serial_for_url(url, timeout=0.0)

    def serve() -> None:
        connection = listening.accept()[0]
        connection.settimeout(0.002)
        manager = PortManager(port, _Writer(connection))
        with connection, suppress(OSError, serial.SerialException):
            while True:
                with suppress(TimeoutError):
                    if not (data := connection.recv(1024)):
                        return
                    port.write(b"".join(manager.filter(data)))
                if data := port.read(4096):
                    connection.sendall(b"".join(manager.escape(data)))

    thread = Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield f"rfc2217://127.0.0.1:{listening.getsockname()[1]}"
    finally:
        thread.join(5.0)
        port.close()
        listening.close()


class _Writer:
    def __init__(self, connection: socket.socket) -> None:
        self.write = connection.sendall
