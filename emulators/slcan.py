"""A serial CAN adapter (Lawicel's text protocol): the emulated bus over a pseudo-terminal, in python-can's `slcan`."""

import re
import weakref
from typing import Final

import can

from tumble.drivers.links.can_address import CanAddress
from tumble.emulators.faults import Faults
from tumble.emulators.serving import Server, serve_pty

DONE: Final = b"\r"
REFUSED: Final = b"\a"

_FRAME: Final = re.compile(r"(?:t([0-9A-F]{3})|T([01][0-9A-F]{7}))([0-8])((?:[0-9A-F]{2})*)")
_SETUP: Final = re.compile(r"[Ss][0-9A-F]*|Y[0-9]*|Z[01]|")
_VERSION: Final = {"V": b"V1013\r", "N": b"NT402\r", "F": b"F00\r"}


class SlcanSession:
    """One adapter; fits `tumble.emulators.serving.Session`. It hears nothing until its channel is opened."""

    def __init__(self, channel: str) -> None:
        self._bus = can.Bus(interface="virtual", channel=channel)
        weakref.finalize(self, self._bus.shutdown)
        self._open = False

    def received(self, data: bytes) -> bytes:
        """Take one command, carriage return included."""
        command = data.decode("ascii", "replace").strip()
        if command in ("O", "L", "C"):
            self._open = command != "C"
            return DONE
        if command in _VERSION:
            return _VERSION[command]
        if frame := _FRAME.fullmatch(command):
            return self._send(frame)
        return DONE if _SETUP.fullmatch(command) else REFUSED

    def due(self) -> bytes:
        """The frames that have come; those that come while the channel is closed are lost."""
        told = b""
        while message := self._bus.recv(0.0):
            if self._open and not message.is_error_frame:
                told += _told(message)
        return told

    def _send(self, frame: re.Match[str]) -> bytes:
        standard, extended, length, octets = frame.groups()
        data = bytes.fromhex(octets)
        if not self._open or len(data) != int(length):
            return REFUSED
        can_id = int(standard or extended, 16)
        self._bus.send(can.Message(arbitration_id=can_id, is_extended_id=standard is None, data=data))
        return (b"z" if standard else b"Z") + DONE


def _told(message: can.Message) -> bytes:
    start = f"T{message.arbitration_id:08X}" if message.is_extended_id else f"t{message.arbitration_id:03X}"
    return f"{start}{len(message.data)}{message.data.hex().upper()}\r".encode()


def serve_slcan(channel: str, faults: Faults | None = None) -> Server:
    """Serve a virtual channel over a pseudo-terminal. Raises `OSError` on Windows, which has none.

    Of the faults only `drop` and `noise` have a meaning here; the others belong to the instruments on the bus.
    """
    return serve_pty(lambda: SlcanSession(channel), faults, terminators=DONE)


def slcan_address(server: Server) -> CanAddress:
    """Where a driver finds the bus; one client at a time."""
    return CanAddress(interface="slcan", channel=server.url, options={"sleep_after_open": 0.0})
