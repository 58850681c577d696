"""The way of an emulated CiA 402 drive to its bus, and what may happen to its answers there."""

import time
from threading import Lock
from typing import Final

import can
import canopen

from tumble.drivers.links.can_link import BUS_OFF
from tumble.emulators.faults import WIRE, Fault, Faults
from tumble.emulators.foreign_frames import foreign_frames

_EMERGENCY: Final = 0x80
_SDO_ANSWER: Final = 0x580
_HEARTBEAT: Final = 0x700
_FUNCTION: Final = 0x780

Frame = tuple[int, bytes]


class DriveNetwork(canopen.Network):
    """A network from which a node can vanish for a while, and on which its SDO answers can be spoilt.

    An answer that is garbled or has a wrong checksum is thrown away by every controller on a CAN bus, and so never
    comes. One that is cut has half its bytes; a reordered one comes behind the next frame of any kind.
    """

    NOTIFIER_CYCLE = 0.05

    silent = False

    def __init__(self, bus: can.BusABC, faults: Faults) -> None:
        super().__init__(bus)
        self._faults = faults
        self._lock = Lock()
        self._later: list[tuple[float, Frame]] = []
        self._behind: Frame | None = None

    def send_message(self, can_id: int, data: bytes, remote: bool = False) -> None:
        """Send, unless silent."""
        if self.silent:
            return
        fault = self._faults.take(*WIRE) if can_id & _FUNCTION == _SDO_ANSWER else None
        with self._lock:
            held, self._behind = self._behind, None
            told = [(can_id, bytes(data))] if fault is None else self._spoilt((can_id, bytes(data)), fault)
            for frame in (*told, *([held] if held else [])):
                super().send_message(*frame, remote)

    def send_late(self) -> None:
        """Send the late answers whose time has come."""
        with self._lock:
            now_s = time.monotonic()
            ripe = [frame for time_s, frame in self._later if time_s <= now_s]
            self._later = [entry for entry in self._later if entry[0] > now_s]
            for frame in ripe:
                super().send_message(*frame)

    def notify(self, can_id: int, data: bytearray, timestamp: float) -> None:
        """Hear, unless silent."""
        if not self.silent:
            super().notify(can_id, data, timestamp)

    def report_bus_off(self) -> None:
        """Have every interface on the bus say what a controller says that has switched itself off."""
        if self.bus is not None:
            self.bus.send(can.Message(arbitration_id=BUS_OFF, is_error_frame=True, is_extended_id=True))

    def send_foreign(self, node_id: int) -> None:
        """Send what nobody can use, under the identifiers of a node's emergencies, SDO answers and heartbeat."""
        if self.bus is not None:
            for function in (_EMERGENCY, _SDO_ANSWER, _HEARTBEAT):
                for message in foreign_frames(function + node_id):
                    if function == _SDO_ANSWER or len(message.data) != 8:  # whole ones would say something
                        self.bus.send(message)

    def _spoilt(self, frame: Frame, fault: Fault) -> list[Frame]:
        """What is sent at once in place of an answer."""
        can_id, data = frame
        if fault.kind == "late":
            self._later.append((time.monotonic() + fault.lasts_s, frame))
        elif fault.kind == "reorder":
            self._behind = frame
        elif fault.kind == "double":
            return [frame, frame]
        elif fault.kind == "cut":
            return [(can_id, data[: len(data) // 2])]
        return []
