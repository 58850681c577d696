"""A whole emulated stand: one world, its head and its DAQ behind the protocols that a stand file names."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

from tumble.drivers.driver import SIMULATED
from tumble.drivers.tables import DaqTable, HeadTable, Instrument
from tumble.emulators.backstage import backstage_of
from tumble.emulators.faults import Faults
from tumble.emulators.scpi.models import Messages
from tumble.emulators.serving import Server, Session, serve_pty, serve_tcp
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.messages import Message

if TYPE_CHECKING:  # cantools is there only where a stand has a CAN DAQ
    from tumble.drivers.candaq import DaqFrames


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """How a stand is to be served."""

    head: HeadTable
    daq: DaqTable
    """Tables of the stand file; what is simulated there is served as `zaber` and `scpi`.

    A manual head speaks no protocol: it is turned backstage.
    """
    head_port: int = 0
    """TCP port; 0 for any that is free. Where head and DAQ share a CAN bus, that of the head serves both."""
    daq_port: int = 0
    folder: Path = Path()
    """Where relative paths of the stand file begin."""
    meter: str = "34461A"
    """Which multimeter is served, one of `tumble.emulators.scpi.MODELS`."""
    meter_messages: Messages | None = None
    """What it makes of several queries in one message, where that is not what the model does."""
    ptys: bool = False
    """Whether each is served on a pseudo-terminal too (not on Windows)."""


def emulate(stack: ExitStack, shared: SharedWorld, wanted: Wanted, faults: StandFaults | None = None) -> dict[str, str]:
    """Serve a stand until `stack` is closed; nothing goes wrong there but `faults`.

    Returns the addresses of `head`, unless it is a manual one, and of `daq` as a stand file writes them, and those of
    their pseudo-terminals.

    Raises
    ------
    ValueError
        An instrument whose driver has no emulator.
    OSError
        A port is taken, or there are no pseudo-terminals.
    """
    return _Emulation(stack, shared, wanted, faults or StandFaults(None, shared.clock, lambda: 0)).addresses()


class _Emulation:
    def __init__(self, stack: ExitStack, shared: SharedWorld, wanted: Wanted, faults: StandFaults) -> None:
        self._stack, self._shared, self._wanted, self._faults = stack, shared, wanted, faults
        self._head_faults, self._daq_faults = faults.of("head"), faults.of("daq")
        self._channel = f"tumble-{uuid4().hex}"
        self._bus_address: dict[str, str] = {}

    def addresses(self) -> dict[str, str]:
        found = self._head() | self._daq()
        self._stack.enter_context(backstage_of(self._shared, tuple(found.values()), self._faults.of("operator")))
        return found

    def _head(self) -> dict[str, str]:
        table = self._wanted.head
        known = {SIMULATED: self._zaber, "zaber": self._zaber, "cia402": self._cia402, "manual": dict[str, str]}
        return _served(table, known)

    def _daq(self) -> dict[str, str]:
        return _served(self._wanted.daq, {SIMULATED: self._scpi, "scpi": self._scpi, "can": self._candaq})

    def _zaber(self) -> dict[str, str]:
        from tumble.emulators.zaber import EmulatedZaber

        stage = EmulatedZaber(self._shared, steps_per_deg=self._wanted.head.steps_per_deg, faults=self._head_faults)
        return self._lines("head", stage.session, self._wanted.head_port, self._head_faults)

    def _cia402(self) -> dict[str, str]:
        from tumble.drivers.cia402.declaration import Cia402Table
        from tumble.emulators.cia402 import EmulatedDrive

        table = self._wanted.head
        assert isinstance(table, Cia402Table)
        drive = EmulatedDrive(
            self._shared, self._channel, self._head_faults, node_id=table.node, steps_per_deg=table.steps_per_deg
        )
        self._stack.callback(drive.close)
        return self._bus("head", self._wanted.head_port)

    def _scpi(self) -> dict[str, str]:
        from tumble.emulators.scpi import Multimeter, ScpiSession

        meter = Multimeter(
            self._shared, self._daq_faults, model=self._wanted.meter, messages=self._wanted.meter_messages
        )
        return self._lines("daq", lambda: ScpiSession(meter), self._wanted.daq_port, self._daq_faults)

    def _candaq(self) -> dict[str, str]:
        from tumble.emulators.candaq import EmulatedCanDaq

        daq = EmulatedCanDaq(self._shared, self._channel, self._daq_faults, self._frames())
        self._stack.callback(daq.close)
        return self._bus("daq", self._wanted.daq_port)

    def _frames(self) -> "DaqFrames | None":
        """What the DBC file of the stand says, where it has one. Raises `ValueError`."""
        from tumble.drivers.candaq.declaration import CanDaqTable, frames_of

        table = self._wanted.daq
        frames = frames_of(table, self._wanted.folder) if isinstance(table, CanDaqTable) else None
        if frames is not None and frames.free_running:
            raise ValueError(
                Message("there is no emulator for a CAN DAQ that sends by itself; leave dbc and signals out")
            )
        return frames

    def _lines(self, name: str, session: Callable[[], Session], port: int, faults: Faults) -> dict[str, str]:
        """Serve a protocol of lines."""
        found = {name: self._kept(serve_tcp(session, port, faults)).url}
        if self._wanted.ptys:
            found[f"{name}_pty"] = self._kept(serve_pty(session, faults)).url
        return found

    def _bus(self, name: str, port: int) -> dict[str, str]:
        """Serve the CAN bus, once, whoever asks first."""
        from tumble.emulators.slcan import serve_slcan, slcan_address
        from tumble.emulators.socketcand import serve_socketcand, socketcand_address

        if not self._bus_address:
            on_bus = {"head": self._wanted.head.driver == "cia402", "daq": self._wanted.daq.driver == "can"}
            faults = self._faults.of_bus([device for device, on in on_bus.items() if on])
            self._bus_address[""] = socketcand_address(self._kept(serve_socketcand(self._channel, port, faults))).url
            if self._wanted.ptys:
                self._bus_address["_pty"] = slcan_address(self._kept(serve_slcan(self._channel, faults))).url
        return {f"{name}{suffix}": address for suffix, address in self._bus_address.items()}

    def _kept(self, server: Server) -> Server:
        return self._stack.enter_context(server)


def _served(table: Instrument, emulators: Mapping[str, Callable[[], dict[str, str]]]) -> dict[str, str]:
    """Serve the instrument by the emulator that there is for its driver."""
    if table.driver not in emulators:
        known = ", ".join(emulators)
        raise ValueError(
            Message(
                "there is no emulator for the driver {driver}; there are some for {known}",
                driver=table.driver,
                known=known,
            )
        )
    return emulators[table.driver]()
