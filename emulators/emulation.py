"""A whole emulated stand: one world, its instruments behind the protocols that a stand file names."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar
from uuid import uuid4

from tumble.drivers.driver import SIMULATED
from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.tables import CHAMBER, DAQ, EXCITER, HEAD, ChamberTable, DaqTable, HeadTable, Instrument
from tumble.emulators.backstage import backstage_of
from tumble.emulators.faults import Faults, JointFaults
from tumble.emulators.scpi.models import Messages
from tumble.emulators.serving import Server, Session, serve_pty, serve_tcp
from tumble.emulators.stand_faults import OPERATOR, StandFaults
from tumble.emulators.world import SharedWorld
from tumble.messages import Message

if TYPE_CHECKING:  # cantools is there only where a stand has a CAN DAQ
    from tumble.drivers.candaq import DaqFrames

Kind = TypeVar("Kind")


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """How a stand is to be served.

    What is simulated in its tables is served as `zaber`, all axes on one line, and as `scpi`, or as a `scanner` where
    it has several channels. A manual head speaks no protocol: it is turned backstage.
    """

    head: HeadTable | None = None
    daq: DaqTable | None = None
    """Tables of the stand file, where it has a head and a DAQ."""
    positioners: Mapping[str, HeadTable] = field(default_factory=dict)
    samplers: Mapping[str, DaqTable] = field(default_factory=dict)
    """The tables of further ones, by name."""
    chamber: ChamberTable | None = None
    exciter: ExciterTable | None = None
    head_port: int = 0
    """TCP port; 0 for any that is free. Where head and DAQ share a CAN bus, that of the head serves both."""
    daq_port: int = 0
    ports: Mapping[str, int] = field(default_factory=dict)
    """Of further instruments, by name; those that share an address are served at the port of the first."""
    folder: Path = Path()
    """Where relative paths of the stand file begin."""
    meter: str = "34461A"
    """Which multimeter is served, one of `tumble.emulators.scpi.MODELS`."""
    meter_messages: Messages | None = None
    """What it makes of several queries in one message, where that is not what the model does."""
    ptys: bool = False
    """Whether each is served on a pseudo-terminal too (not on Windows)."""

    @property
    def heads(self) -> Mapping[str, HeadTable]:
        """All positioners, by name."""
        return ({HEAD: self.head} if self.head else {}) | dict(self.positioners)

    @property
    def daqs(self) -> Mapping[str, DaqTable]:
        """All samplers, by name."""
        return ({DAQ: self.daq} if self.daq else {}) | dict(self.samplers)

    def port(self, name: str) -> int:
        """TCP port of an instrument."""
        return {HEAD: self.head_port, DAQ: self.daq_port, **self.ports}.get(name, 0)


def emulate(stack: ExitStack, shared: SharedWorld, wanted: Wanted, faults: StandFaults | None = None) -> dict[str, str]:
    """Serve a stand until `stack` is closed; nothing goes wrong there but `faults`.

    Returns the addresses of all instruments that are not manual by their names, as a stand file writes them, and those
    of their pseudo-terminals.

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
        self._channel = f"tumble-{uuid4().hex}"
        self._bus_address: dict[str, str] = {}

    def addresses(self) -> dict[str, str]:
        others = [name for name in (CHAMBER, EXCITER) if getattr(self._wanted, name)]
        self._faults.check([*self._wanted.heads, *self._wanted.daqs, *others])
        found = self._heads()
        for name, table in self._wanted.daqs.items():
            kinds = {
                SIMULATED: self._meter,
                "scpi": self._scpi,
                "scanner": self._scanner,
                "can": self._candaq,
                "lines": self._told_in_lines,
            }
            found |= _emulator(table, kinds)(name, table)
        if self._wanted.chamber:
            found |= _emulator(self._wanted.chamber, {SIMULATED: self._chamber, "modbus": self._chamber})()
        if self._wanted.exciter:
            found |= _emulator(self._wanted.exciter, {SIMULATED: self._generator, "generator": self._generator})()
        self._stack.enter_context(backstage_of(self._shared, tuple(found.values()), self._faults.of(OPERATOR)))
        return found

    def _heads(self) -> dict[str, str]:
        """Serve the positioners, those on one line together."""
        lines: dict[str, dict[str, HeadTable]] = {}
        found: dict[str, str] = {}
        for name, table in self._wanted.heads.items():
            kinds = {SIMULATED: "zaber", "zaber": "zaber", "cia402": "cia402", "manual": ""}
            match _emulator(table, kinds):
                case "zaber":
                    lines.setdefault("" if table.driver == SIMULATED else table.address, {})[name] = table
                case "cia402":
                    found |= self._cia402(name, table)
        for tables in lines.values():
            found |= self._zaber(tables)
        return {name: found[name] for name in _in_order(found, self._wanted.heads)}

    def _zaber(self, tables: Mapping[str, HeadTable]) -> dict[str, str]:
        from tumble.emulators.zaber_line import ZaberChain
        from tumble.emulators.zaber_stages import stages

        faults = {name: self._faults.of(name) for name in tables}
        devices = stages(self._shared, tables, faults)
        first = next(iter(tables))
        joint = next(iter(faults.values())) if len(faults) == 1 else JointFaults(list(faults.values()))
        served = self._lines(first, lambda: ZaberChain(devices), joint)
        return {other.replace(first, name, 1): url for name in tables for other, url in served.items()}

    def _cia402(self, name: str, table: HeadTable) -> dict[str, str]:
        from tumble.drivers.cia402.declaration import Cia402Table
        from tumble.emulators.cia402 import EmulatedDrive

        assert isinstance(table, Cia402Table)
        drive = EmulatedDrive(
            self._shared.wired_to(head=name),
            self._channel,
            self._faults.of(name),
            node_id=table.node,
            steps_per_deg=table.steps_per_deg,
        )
        self._stack.callback(drive.close)
        return self._bus(name)

    def _meter(self, name: str, table: DaqTable) -> dict[str, str]:
        """What serves a simulated voltmeter, by the number of its channels. Raises `ValueError` for what is none."""
        if other := next((channel for channel in table.channels if not channel.endswith("_v")), ""):
            raise ValueError(
                Message(
                    "the {name} has the channel {channel}, which no voltmeter tells; "
                    "name the driver that reads it, lines or can, and what it sends",
                    name=name,
                    channel=other,
                )
            )
        return (self._scanner if len(table.channels) > 1 else self._scpi)(name, table)

    def _scpi(self, name: str, table: DaqTable) -> dict[str, str]:
        from tumble.emulators.scpi import Multimeter, ScpiSession

        faults = self._faults.of(name)
        world = self._shared.wired_to(channels=table.channels)
        meter = Multimeter(world, faults, model=self._wanted.meter, messages=self._wanted.meter_messages)
        return self._lines(name, lambda: ScpiSession(meter), faults)

    def _scanner(self, name: str, table: DaqTable) -> dict[str, str]:
        from tumble.emulators.scpi import ScpiSession
        from tumble.emulators.scpi.scanner import scanner_of

        faults = self._faults.of(name)
        scanner = scanner_of(self._shared, table, faults)
        return self._lines(name, lambda: ScpiSession(scanner), faults)

    def _candaq(self, name: str, table: DaqTable) -> dict[str, str]:
        from tumble.drivers.candaq.declaration import CanDaqTable
        from tumble.emulators.candaq import EmulatedCanDaq
        from tumble.emulators.candaq_free import EmulatedFreeCanDaq

        daq: EmulatedCanDaq | EmulatedFreeCanDaq
        faults = self._faults.of(name)
        if isinstance(table, CanDaqTable) and table.channel_signals:
            world = self._shared.wired_to(channels=tuple(table.channel_signals))
            daq = EmulatedFreeCanDaq(world, self._channel, faults, table, self._wanted.folder)
        else:
            world = self._shared.wired_to(channels=table.channels)
            daq = EmulatedCanDaq(world, self._channel, faults, self._frames(table))
        self._stack.callback(daq.close)
        return self._bus(name)

    def _told_in_lines(self, name: str, table: DaqTable) -> dict[str, str]:
        from tumble.drivers.lines.declaration import LinesTable
        from tumble.emulators.lines import EmulatedLines, LinesSession

        assert isinstance(table, LinesTable)
        faults = self._faults.of(name)
        instrument = EmulatedLines(self._shared.wired_to(channels=tuple(table.measured)), table, faults)
        return self._lines(name, lambda: LinesSession(instrument), faults)

    def _chamber(self) -> dict[str, str]:
        from tumble.emulators.modbus import REGISTERS, EmulatedChamber, is_whole

        assert self._wanted.chamber
        registers = getattr(self._wanted.chamber, "registers", REGISTERS)
        faults = self._faults.of(CHAMBER)
        session = EmulatedChamber(self._shared, registers, faults)
        server = serve_tcp(lambda: session, self._wanted.port(CHAMBER), faults, whole=is_whole)
        return {CHAMBER: self._kept(server).url}

    def _generator(self) -> dict[str, str]:
        """What drives the shakers; of one that is only simulated, one output of 2 g/V."""
        from tumble.drivers.generator.table import GeneratorTable
        from tumble.emulators.scpi import ScpiSession
        from tumble.emulators.scpi.generator import EmulatedGenerator

        table, faults = self._wanted.exciter, self._faults.of(EXCITER)
        gains = {1: ("x", 2.0)}
        if isinstance(table, GeneratorTable):
            gains = {output.channel: (str(axis), output.g_per_v) for axis, output in table.outputs.items()}
        generator = EmulatedGenerator(self._shared, gains, faults)
        return self._lines(EXCITER, lambda: ScpiSession(generator), faults)

    def _frames(self, table: DaqTable) -> "DaqFrames | None":
        """What the DBC file of the stand says, where it has one. Raises `ValueError`."""
        from tumble.drivers.candaq.declaration import CanDaqTable, frames_of

        frames = frames_of(table, self._wanted.folder) if isinstance(table, CanDaqTable) else None
        if frames is not None and frames.free_running:
            raise ValueError(
                Message("there is no emulator for a CAN DAQ that sends by itself; leave dbc and signals out")
            )
        return frames

    def _lines(self, name: str, session: Callable[[], Session], faults: Faults) -> dict[str, str]:
        """Serve a protocol of lines."""
        found = {name: self._kept(serve_tcp(session, self._wanted.port(name), faults)).url}
        if self._wanted.ptys:
            found[f"{name}_pty"] = self._kept(serve_pty(session, faults)).url
        return found

    def _bus(self, name: str) -> dict[str, str]:
        """Serve the CAN bus, once, whoever asks first."""
        from tumble.emulators.slcan import serve_slcan, slcan_address
        from tumble.emulators.socketcand import serve_socketcand, socketcand_address

        if not self._bus_address:
            tables: Mapping[str, Instrument] = {**self._wanted.heads, **self._wanted.daqs}
            faults = self._faults.of_bus([each for each, table in tables.items() if table.driver in ("cia402", "can")])
            port = self._wanted.port(name)
            self._bus_address[""] = socketcand_address(self._kept(serve_socketcand(self._channel, port, faults))).url
            if self._wanted.ptys:
                self._bus_address["_pty"] = slcan_address(self._kept(serve_slcan(self._channel, faults))).url
        return {f"{name}{suffix}": address for suffix, address in self._bus_address.items()}

    def _kept(self, server: Server) -> Server:
        return self._stack.enter_context(server)


def _in_order(found: Mapping[str, str], heads: Mapping[str, HeadTable]) -> list[str]:
    """The names under which there are addresses, in the order of the stand file."""
    return [name for head in heads for name in (head, f"{head}_pty") if name in found]


def _emulator(table: Instrument, emulators: Mapping[str, Kind]) -> Kind:
    """What there is for the driver of an instrument. Raises `ValueError` where there is nothing."""
    if table.driver not in emulators:
        known = ", ".join(emulators)
        raise ValueError(
            Message(
                "there is no emulator for the driver {driver}; there are some for {known}",
                driver=table.driver,
                known=known,
            )
        )
    return emulators[table.driver]
