"""A CAN bus of any make, shared by the instruments on it; a lost one is told as such."""

import logging
import socket
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Final

import can
from can.interfaces.socketcand import SocketCanDaemonBus

from drivers.errors import LinkLostError
from drivers.links.can_address import CanAddress

SEND_TIMEOUT_S: Final = 1.0
CONNECT_TIMEOUT_S: Final = 2.0
BUS_OFF: Final = 0x40
"""Bit of an error frame's identifier that says bus-off (linux/can/error.h, CAN_ERR_BUSOFF)."""

_RECEIVE_S: Final = 0.1
"""One wait for a frame; also how soon a closed link is noticed."""
_SILENT_READS: Final = 20
_TROUBLE = (can.CanError, OSError, NotImplementedError)

Listener = Callable[[can.Message], None]

logging.getLogger("can").addHandler(logging.NullHandler())  # what it warns of is raised or checked here


class CanLink:
    """An open CAN bus. Several instruments may share one; whoever subscribes stays subscribed when it is reopened.

    Frames are handed to the subscribers by a thread of the link.

    Parameters
    ----------
    address
        Where the bus is.

    Raises
    ------
    LinkLostError
        The bus cannot be opened.
    """

    def __init__(self, address: CanAddress) -> None:
        self.address = address
        self.generation = 0
        """How often the bus has been opened."""
        self._lock = threading.Lock()
        self._listeners: list[Listener] = []
        self._trouble = "it is closed"
        self._bus: can.BusABC | None = None
        self._thread: threading.Thread | None = None
        self.reopen(self.generation)

    def subscribe(self, listener: Listener) -> None:
        """Call `listener` with every frame from now on, in the link's own thread; it must not wait."""
        self._listeners.append(listener)

    def send(self, can_id: int, data: bytes) -> None:
        """Send a data frame; identifiers above 7FFh are extended ones. Raises `LinkLostError`."""
        message = can.Message(arbitration_id=can_id, is_extended_id=can_id > 0x7FF, data=data)
        with self._lock:
            bus = self._open_bus()
            try:
                bus.send(message, timeout=SEND_TIMEOUT_S)
            except _TROUBLE as error:
                self._trouble = str(error)
                raise self._lost() from error

    def check(self) -> None:
        """Make sure that the bus is there. Raises `LinkLostError`."""
        with self._lock:
            self._open_bus()

    def reopen(self, generation: int) -> int:
        """Open the bus anew, unless another instrument has done so since it was opened for the `generation`-th time.

        Returns the generation that is open now. Raises `LinkLostError` while the bus is not there.
        """
        if generation == self.generation:
            self.close()
            try:
                bus = _open(self.address)
            except (*_TROUBLE, ValueError, TypeError) as error:
                self._trouble = str(error)
                raise self._lost() from error
            self.generation += 1
            self._trouble = ""
            self._bus = bus
            name = f"receiving from {self.address.url}"
            self._thread = threading.Thread(target=self._receive, args=(bus,), name=name, daemon=True)
            self._thread.start()
        return self.generation

    def close(self) -> None:
        """Leave the bus; a closed link stays closed until it is reopened."""
        bus, self._bus = self._bus, None
        self._trouble = "it is closed"
        if self._thread is not None:
            self._thread.join()
        if bus is not None:
            with suppress(Exception):  # what is lost cannot be closed properly
                bus.shutdown()

    def _open_bus(self) -> can.BusABC:
        if self._bus is None or self._trouble:
            raise self._lost()
        return self._bus

    def _lost(self) -> LinkLostError:
        return LinkLostError(
            f"CAN bus {self.address.url}",
            f"the link is lost ({self._trouble})",
            "check interface, cable, termination and bit rate; the run can be resumed",
        )

    def _receive(self, bus: can.BusABC) -> None:
        while bus is self._bus:
            try:
                message = bus.recv(_RECEIVE_S)
            except ValueError:
                continue  # garbled text of a serial adapter: no frame came of it
            except _TROUBLE as error:
                self._trouble = str(error) or type(error).__name__
                return
            if message is not None:
                self._deliver(message)

    def _deliver(self, message: can.Message) -> None:
        if message.is_error_frame:
            if message.arbitration_id & BUS_OFF:
                self._trouble = "bus-off: too many errors on the wire, and the interface took itself off"
            return
        if message.is_remote_frame:
            return
        for listener in list(self._listeners):
            listener(message)


class _Socketcand(SocketCanDaemonBus):
    """A bus of a socketcand server, which notices when the server has closed the connection.

    python-can takes the end of the stream for silence and reads it again at once, for ever.
    """

    _ends = 0

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        began_s = time.monotonic()
        message, filtered = super()._recv_internal(timeout)  # type: ignore[no-untyped-call]
        early = message is None and timeout is not None and time.monotonic() - began_s < timeout / 2
        self._ends = self._ends + 1 if early else 0
        if self._ends > _SILENT_READS:
            raise can.CanOperationError("the server has closed the connection")
        return message, filtered


def _open(address: CanAddress) -> can.BusABC:
    options: dict[str, Any] = dict(address.options)
    if address.interface == "socketcand":
        if not {"host", "port"} <= options.keys():
            raise ValueError("socketcand needs the options host and port")
        # python-can would knock for 10 s without a pause where nobody listens
        socket.create_connection((str(options["host"]), int(options["port"])), CONNECT_TIMEOUT_S).close()
        return _Socketcand(channel=address.channel, **options)  # type: ignore[no-untyped-call]
    return can.Bus(channel=address.channel, interface=address.interface, **options)
