"""An emulated CiA 402 drive on CANopen, which turns the simulated head."""

import threading
import time
from collections import deque
from typing import Any, Final

import can
import canopen
from canopen.pdo.base import PdoMap

from tumble.drivers.cia402 import objects
from tumble.emulators.cia402_axis import Axis
from tumble.emulators.cia402_bus import DriveNetwork
from tumble.emulators.cia402_drive import ERROR_REGISTER, OVERHEATED, Drive
from tumble.emulators.cia402_habits import HABITS
from tumble.emulators.faults import Fault, Faults, Kind
from tumble.emulators.world import SharedWorld

CYCLE_S: Final = 0.02
"""Time between two transmissions of the TPDOs: a master of the profile waits for them."""

_KINDS: Final[tuple[Kind, ...]] = (
    "power_loss",
    "bus_off",
    "heartbeat_lost",
    "emergency",
    "swapped",
    "foreign_frames",
    *HABITS,
)
"""Faults of the node; those of the axis are the axis's."""

_RESET_NODE: Final = 129
_RESET_COMMUNICATION: Final = 130


class EmulatedDrive:
    """A drive on a python-can `virtual` channel, with a thread of its own until it is closed.

    It is not homed when it is switched on.

    Parameters
    ----------
    world
        The simulated stand.
    channel
        Name of the virtual channel.
    faults
        What goes wrong; nothing by default. Controlwords are its commands, as in `controlword 001F`.
    node_id
        1 to 127.
    steps_per_deg
        Position units per degree, sign included.
    """

    def __init__(
        self,
        world: SharedWorld,
        channel: str,
        faults: Faults | None = None,
        *,
        node_id: int = 1,
        steps_per_deg: float = 1000.0,
    ) -> None:
        self._faults = faults or Faults()
        self._node_id = node_id
        self._struck: deque[Fault] = deque()
        """Faults that came with a command and have yet to happen."""
        self._drive = Drive(Axis(world, self._faults, steps_per_deg))
        self._network = DriveNetwork(can.Bus(interface="virtual", channel=channel), self._faults)
        self._network.connect()
        self._node = self._make_node(node_id)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._live, name=f"CiA 402 drive {node_id}", daemon=True)
        self._boot()
        self._thread.start()

    def close(self) -> None:
        """Switch it off for good; returns when its threads have ended."""
        self._closing.set()
        self._thread.join()
        self._beat(0)
        self._network.disconnect()

    def _make_node(self, node_id: int) -> canopen.LocalNode:
        node = canopen.LocalNode(node_id, objects.object_dictionary(node_id))
        self._network[node_id] = node
        node.add_read_callback(self._read)  # type: ignore[no-untyped-call]
        node.add_write_callback(self._write)  # type: ignore[no-untyped-call]
        node.rpdo.read()  # type: ignore[no-untyped-call]
        node.tpdo.read()  # type: ignore[no-untyped-call]
        for pdo in node.rpdo.values():
            pdo.add_callback(self._take_pdo)
        self._network.subscribe(0, self._hear_nmt)
        return node

    def _boot(self) -> None:
        """Begin as after switching on: boot-up message, then pre-operational, without a heartbeat."""
        self._drive.restart()
        self._node.data_store.clear()
        self._beat(0)
        self._node.nmt.state = "INITIALISING"
        self._node.nmt.state = "PRE-OPERATIONAL"

    def _live(self) -> None:
        while not self._closing.wait(CYCLE_S):
            self._suffer()
            self._drive.update()
            while self._drive.emergencies:
                code = self._drive.emergencies.popleft()
                self._node.emcy.send(code, ERROR_REGISTER if code else 0)
            self._network.send_late()
            if self._node.nmt.state == "OPERATIONAL":
                self._send_pdos()

    def _send_pdos(self) -> None:
        for pdo in self._node.tpdo.values():
            for variable in pdo:
                value = self._drive.value(variable.index, variable.subindex)
                assert isinstance(value, int)
                variable.raw = value
            pdo.transmit()

    def _suffer(self) -> None:
        """Have the fault happen that is due, if any."""
        fault = self._struck.popleft() if self._struck else self._faults.take(*_KINDS)
        if fault is None:
            return
        if fault.kind == "swapped":
            self._drive.serial += 1
        elif fault.kind in HABITS:
            self._drive.habits.take_on(fault)
        elif fault.kind == "foreign_frames":
            self._network.send_foreign(self._node_id)
        elif fault.kind == "emergency":
            self._drive.fail(OVERHEATED)
        elif fault.kind == "heartbeat_lost":
            self._pause(fault.lasts_s)
        elif fault.kind == "bus_off":
            self._network.report_bus_off()
            self._be_silent(fault.lasts_s)
        else:
            self._drive.axis.lose_power()
            self._be_silent(fault.lasts_s)
            self._boot()

    def _be_silent(self, lasts_s: float) -> None:
        self._network.silent = True
        self._pause(lasts_s)
        self._network.silent = False

    def _pause(self, lasts_s: float) -> None:
        """Give no heartbeat for so many seconds of the computer, then go on as the master has set it."""
        self._beat(0)
        ends_s = time.monotonic() + lasts_s
        while time.monotonic() < ends_s and not self._closing.wait(CYCLE_S):
            self._drive.update()
        self._beat(int.from_bytes(self._node.get_data(objects.HEARTBEAT_MS, 0), "little"))

    def _beat(self, period_ms: int) -> None:
        """Give a heartbeat every `period_ms`; 0 for none."""
        self._node.nmt.start_heartbeat(period_ms)

    def _hear_nmt(self, _can_id: int, data: bytearray, _timestamp: float) -> None:
        command, addressed = data[:1], int.from_bytes(data[1:2], "little")
        if addressed not in (0, self._node.id):
            return
        if command == bytes([_RESET_NODE]):
            self._drive.axis.lose_power()
            self._boot()
        elif command == bytes([_RESET_COMMUNICATION]):
            self._boot()

    def _take_pdo(self, pdo: PdoMap) -> None:
        if self._node.nmt.state == "OPERATIONAL":
            for variable in pdo:
                self._node.set_data(variable.index, variable.subindex, variable.data)

    def _read(self, index: int, subindex: int, **_: Any) -> int | str | None:  # noqa: ANN401  # as canopen calls it
        return self._drive.value(index, subindex)

    def _write(self, index: int, data: bytes, **_: Any) -> None:  # noqa: ANN401  # as canopen calls it
        value = int.from_bytes(data, "little", signed=index != objects.CONTROLWORD)
        if index == objects.CONTROLWORD:
            self._faults.note_command(f"controlword {value:04X}".encode())
        self._drive.set_value(index, value)
        if fault := self._faults.take(*_KINDS):
            self._struck.append(fault)
