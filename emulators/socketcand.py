"""A small socketcand server: another process reaches the emulated bus over loopback TCP, in python-can's `socketcand`.

The protocol is that of https://github.com/linux-can/socketcand, in its raw mode: `< send ID LENGTH BYTES >` from the
client, `< frame ID TIME BYTES >` to it.
"""

import re
import time
import weakref
from typing import Final

import can

from tumble.drivers.links.can_address import CanAddress, Option
from tumble.emulators.faults import Faults
from tumble.emulators.serving import Server, serve_tcp

CHANNEL: Final = "can0"
"""What the bus is called towards clients; they may call it anything."""

_SEND: Final = re.compile(rb"< *send +([0-9a-fA-F]{1,8}) +([0-8])((?: +[0-9a-fA-F]{1,2})*) *>")
_QUIET_S: Final = 0.05
"""Pause after raw mode was granted: python-can wants to read that alone."""
_ANSWERS: Final = {b"open": b"< ok >", b"rawmode": b"< ok >", b"echo": b"< echo >"}


class SocketcandSession:
    """One client's conversation; fits `tumble.emulators.serving.Session`."""

    def __init__(self, channel: str) -> None:
        self._bus = can.Bus(interface="virtual", channel=channel)
        weakref.finalize(self, self._bus.shutdown)
        self._greeting = b"< hi >"
        self._speaks_from_s: float | None = None

    def received(self, data: bytes) -> bytes:
        """Hear one message, `>` included; what is none is passed by."""
        words = data.strip(b"\r\n <>").split()
        verb = words[0] if words else b""
        if verb == b"rawmode":
            self._speaks_from_s = time.monotonic() + _QUIET_S
        if sent := _SEND.search(data):
            self._send(*sent.groups())
        return _ANSWERS.get(verb, b"")

    def due(self) -> bytes:
        """Greet; then, in raw mode, tell the frames that have come."""
        greeting, self._greeting = self._greeting, b""
        if self._speaks_from_s is None or time.monotonic() < self._speaks_from_s:
            return greeting
        told = b""
        while message := self._bus.recv(0.0):
            told += _told(message)
        return told

    def _send(self, identifier: bytes, length: bytes, octets: bytes) -> None:
        data = bytes(int(octet, 16) for octet in octets.split())
        can_id = int(identifier, 16)
        if len(data) == int(length) and can_id < 1 << 29:
            extended = len(identifier) > 3 or can_id > 0x7FF
            self._bus.send(can.Message(arbitration_id=can_id, is_extended_id=extended, data=data))


def _told(message: can.Message) -> bytes:
    digits = 8 if message.is_extended_id or message.is_error_frame else 3
    kind, octets = ("error", "") if message.is_error_frame else ("frame", message.data.hex().upper())
    return f"< {kind} {message.arbitration_id:0{digits}X} {message.timestamp:.6f} {octets} >".encode()


def serve_socketcand(channel: str, port: int = 0, faults: Faults | None = None) -> Server:
    """Serve a virtual channel over TCP on the loopback interface. Raises `OSError` where the port is taken.

    Of the faults only `drop` and `noise` have a meaning here; the others belong to the instruments on the bus.
    """
    return serve_tcp(lambda: SocketcandSession(channel), port, faults, terminators=b">")


def socketcand_address(server: Server) -> CanAddress:
    """Where a driver finds the bus."""
    options: dict[str, Option] = {"host": "127.0.0.1", "port": server.port}
    return CanAddress(interface="socketcand", channel=CHANNEL, options=options)
