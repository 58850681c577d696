"""A CAN bus of any make, shared by the instruments on it; a lost one is told as such."""

import logging
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Final

import can

from tumble.drivers.errors import LinkLostError
from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.opening import opened_unless_stopped
from tumble.drivers.links.patience import PAUSE_S, in_words, is_gone, patiently
from tumble.drivers.links.places import check_server
from tumble.drivers.links.slcan import SlcanBus
from tumble.drivers.links.socketcand import SocketcandBus
from tumble.drivers.links.tally import Tally
from tumble.messages import Message

SEND_TIMEOUT_S: Final = 1.0
"""How long a frame may be tried to be sent, in real time."""
FAILING_S: Final = 1.0
"""How long nothing but failures and spoilt frames may come from a bus, in real time."""
BUS_OFF: Final = 0x40
"""Bit of an error frame's identifier that says bus-off (linux/can/error.h, CAN_ERR_BUSOFF)."""

_RECEIVE_S: Final = 0.1
"""One wait for a frame; also how soon a closed link is noticed."""

Listener = Callable[[can.Message], None]

logging.getLogger("can").addHandler(logging.NullHandler())  # what it warns of is raised or checked here


class CanLink:
    """An open CAN bus. Several instruments may share one; whoever subscribes stays subscribed when it is reopened.

    Frames are handed to the subscribers by a thread of the link. What no instrument here can use, and what came
    spoilt, is dropped and counted in `tally`; whatever else goes wrong in that thread is the trouble of which `check`
    and `send` tell. A bus that fails for a moment is tried again.

    Parameters
    ----------
    address
        Where the bus is.
    check_opening
        Called many times a second while the bus is opened; what it raises breaks that off.

    Raises
    ------
    LinkLostError
        The bus cannot be opened.
    """

    def __init__(self, address: CanAddress, check_opening: Callable[[], object] = lambda: None) -> None:
        self.address, self._check_opening = address, check_opening
        self.generation = 0
        """How often the bus has been opened."""
        self.tally = Tally(Message("CAN bus {url}", url=address.url))
        """What was dropped, and what was tried again."""
        self._lock = threading.Lock()
        self._listeners: list[Listener] = []
        self._trouble: str = Message("it is closed")
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
                patiently(lambda: bus.send(message, timeout=SEND_TIMEOUT_S), SEND_TIMEOUT_S, self._bears)
            except Exception as error:  # every interface of python-can has its own kinds
                self._trouble = self._trouble or in_words(error)
                raise self._lost(self._trouble) from error

    def check(self) -> None:
        """Make sure that the bus is there. Raises `LinkLostError`."""
        with self._lock:
            self._open_bus()

    def reopen(self, generation: int) -> int:
        """Open the bus anew, unless another instrument has done so since it was opened for the `generation`-th time.

        Returns the generation that is open now. Raises `LinkLostError` while the bus is not there, and whatever
        `check_opening` raises.
        """
        if generation == self.generation:
            self.close()
            bus = opened_unless_stopped(
                self._opened, self._check_opening, lambda late: late.shutdown(), self.address.url
            )
            self.generation += 1
            self._trouble = ""
            self._bus = bus
            name = Message("receiving from {url}", url=self.address.url)
            self._thread = threading.Thread(target=self._receive, args=(bus,), name=name, daemon=True)
            self._thread.start()
        return self.generation

    def _opened(self) -> can.BusABC:
        """A bus at the address. Raises `LinkLostError`."""
        try:
            return _open(self.address)
        except Exception as error:  # every interface of python-can has its own kinds
            raise self._lost(in_words(error)) from error

    def close(self) -> None:
        """Leave the bus; a closed link stays closed until it is reopened."""
        bus, self._bus = self._bus, None
        self._trouble = Message("it is closed")
        if self._thread is not None:
            self._thread.join()
        if bus is not None:
            with suppress(Exception):  # what is lost cannot be closed properly
                bus.shutdown()

    def _open_bus(self) -> can.BusABC:
        if self._bus is None or self._trouble:
            raise self._lost(self._trouble)
        return self._bus

    def _lost(self, trouble: str) -> LinkLostError:
        return LinkLostError(
            Message("CAN bus {url}", url=self.address.url),
            Message("the link is lost ({trouble})", trouble=trouble),
            Message("check interface, cable, termination and bit rate; the run can be resumed"),
        )

    def _bears(self, error: Exception) -> bool:
        """Whether to try to send again after an error."""
        if is_gone(error) or self._trouble:
            return False
        self.tally.count(Message("frames sent only after a failure"), in_words(error))
        return True

    def _receive(self, bus: can.BusABC) -> None:
        try:
            good_s = time.monotonic()
            while bus is self._bus:
                try:
                    message = bus.recv(_RECEIVE_S)
                except Exception as error:  # every interface of python-can has its own kinds
                    self._bear(error, time.monotonic() - good_s)
                else:
                    good_s = time.monotonic()
                    self._deliver(message)
        except Exception as error:  # nobody would see it in this thread
            self._trouble = in_words(error)

    def _bear(self, error: Exception, failing_s: float) -> None:
        """Count what could not be received. Raises `error` where it is no use to go on."""
        if is_gone(error) or failing_s > FAILING_S:
            raise error
        if isinstance(error, (can.CanError, OSError)):
            self.tally.count(Message("failures to receive, tried again"), in_words(error))
            time.sleep(PAUSE_S)
        else:
            self.tally.count(Message("cut or garbled frames dropped"), in_words(error))

    def _deliver(self, message: can.Message | None) -> None:
        if message is None:
            return
        if message.is_error_frame and message.arbitration_id & BUS_OFF:
            self._trouble = Message("bus-off: too many errors on the wire, and the interface took itself off")
        if unusable := _unusable(message):
            self.tally.count(
                Message("{unusable} dropped", unusable=unusable),
                Message("identifier {can_id:X}h", can_id=message.arbitration_id),
            )
            return
        for listener in list(self._listeners):
            listener(message)


def _unusable(message: can.Message) -> str:
    """What kind of frame it is, where no instrument here could use it; else empty."""
    kinds = {
        Message("error frames"): message.is_error_frame,
        Message("remote frames"): message.is_remote_frame,
        Message("CAN FD frames"): message.is_fd,
        Message("cut frames"): len(message.data) != message.dlc,
    }
    return next((kind for kind, holds in kinds.items() if holds), "")


def _open(address: CanAddress) -> can.BusABC:
    options: dict[str, Any] = dict(address.options)
    if address.interface == "socketcand":
        check_server(address)
        return SocketcandBus(address.channel, options["host"], options["port"])
    if address.interface == "slcan":
        return SlcanBus(address.channel, **options)
    return can.Bus(channel=address.channel, interface=address.interface, **options)
