"""Emulated stands with two axes in this process, reached by the real drivers through loopback sockets."""

import re
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Final

from tumble.app.running import Job
from tumble.app.simulation import simulation
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.wiring import Connected, connect
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.speed import FasterClock
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.procedures.programmes import load_programme, programme_from_text

_LIMITS: Final = "limits_deg = [-190.0, 190.0]\nspeed_deg_s = 90.0\nsteps_per_deg = 3600.0\n"
_NOWHERE: Final = "socket://127.0.0.1:0"
_ELSEWHERE: Final = "socket://127.0.0.1:1"
"""Another line than that."""
ZABER: Final = "\n".join(
    f'[positioners.{name}]\ndriver = "zaber"\nurl = "{{{name}}}"\naxis = {axis}\n{_LIMITS}'
    for axis, name in enumerate(("outer", "inner"), start=1)
)
"""Two axes of one controller on one line."""
ZABER_CHAIN: Final = ZABER.replace("axis = 1", "device = 1").replace("axis = 2", "device = 2")
"""Two stages in one chain."""
ZABER_LINES: Final = ZABER.replace("axis = 2", "axis = 1").replace("{inner}", "{second}")
"""Two heads, each on a line of its own."""
CIA402: Final = "\n".join(
    f'[positioners.{name}]\ndriver = "cia402"\nurl = "{{{name}}}"\nnode = {node}\n{_LIMITS}'
    for node, name in enumerate(("outer", "inner"), start=1)
)
"""Two nodes on one bus."""
MANUAL: Final = "\n".join(
    f'[positioners.{name}]\ndriver = "manual"\nlimits_deg = [-190.0, 190.0]\n' for name in ("outer", "inner")
)
SCANNER: Final = """[samplers.scanner]
driver = "scanner"
url = "{scanner}"
scan = { u_x_v = 101, u_y_v = 102, u_z_v = 103 }
thermometers = { u_x_v = 111, u_y_v = 112, u_z_v = 113 }
samples = 20
rate_hz = 10.0
"""
METERS: Final = "\n".join(
    f'[samplers.{axis}]\ndriver = "scpi"\nurl = "{{{axis}}}"\nchannels = ["u_{axis}_v"]\nsamples = 20\nrate_hz = 10.0\n'
    for axis in "xyz"
)
"""A multimeter for each output."""
CAN_DAQS: Final = "\n".join(
    f'[samplers.{axis}]\ndriver = "can"\nurl = "{{{axis}}}"\ndbc = "daq_{axis}.dbc"\nchannels = ["u_{axis}_v"]\n'
    "samples = 20\nrate_hz = 10.0\n"
    for axis in "xyz"
)
"""A DAQ for each output, all on the bus of the axes, each with identifiers of its own in its DBC file."""
SIMULATED: Final = (
    "\n".join(f'[positioners.{name}]\ndriver = "simulated"\n{_LIMITS}' for name in ("outer", "inner"))
    + '[samplers.triad]\ndriver = "simulated"\nsamples = 20\nrate_hz = 10.0\n'
)
CHAMBER: Final = """[chamber]
driver = "modbus"
url = "{chamber}"
limits_degC = [-40.0, 120.0]
ramp_K_per_min = 10.0
safe_degC = 23.0

[chamber.registers]
actual = { input = 100, kind = "float32", scale = 1.0, word_order = "little" }
setpoint = { holding = 7 }
run = { coil = 3 }
door = { discrete = 12, when = false }
door_lock = { coil = 4 }
alarm = { discrete = 13 }
"""
SIMULATED_CHAMBER: Final = (
    '[chamber]\ndriver = "simulated"\nlimits_degC = [-40.0, 120.0]\nramp_K_per_min = 10.0\nsafe_degC = 23.0\n'
)
WORLD: Final = '[simulated]\nworld = "two_axes"\nseed = 3\ntemperature = { wander_K = 0.0 }\n'


@dataclass(frozen=True, kw_only=True)
class TwoAxesStand:
    """A stand being served, and what is to be measured there."""

    job: Job
    clock: FasterClock
    shared: SharedWorld
    faults: StandFaults

    def connect(self) -> Connected:
        """Connect the real drivers. Raises `DeviceError`."""
        return connect(self.job.stand, clock=self.clock)


@contextmanager
def served(
    folder: Path, instruments: str, programme: str, speed: float = 30.0, world: str = WORLD
) -> Iterator[TwoAxesStand]:
    """Serve a stand of these tables while the context lasts; `programme` is a name, or TOML."""
    clock = FasterClock(speed)
    anywhere = stand_of(folder, instruments, {}, world)
    simulated = simulation(anywhere, clock)
    shared = SharedWorld(simulated)
    faults = StandFaults(None, clock, lambda: simulated.world.counts.dwells)
    file = anywhere.file
    wanted = Wanted(positioners=file.positioners, samplers=file.samplers, chamber=file.chamber_table, folder=folder)
    with ExitStack() as stack:
        stand = stand_of(folder, instruments, emulate(stack, shared, wanted, faults), world)
        yield TwoAxesStand(job=job_at(stand, programme), clock=clock, shared=shared, faults=faults)


def stand_of(folder: Path, instruments: str, where: Mapping[str, str], world: str = WORLD) -> LoadedStand:
    """The stand whose instruments have these addresses, by their names; anywhere where nothing is said."""
    text = instruments
    for name in ("outer", "inner", "scanner", "x", "y", "z", "triad", "chamber"):
        on_can = "cia402" in instruments and name in ("outer", "inner")
        on_can = on_can or ('"can"' in instruments and name in ("x", "y", "z"))
        nowhere = "virtual:anywhere" if on_can else _NOWHERE
        text = text.replace(f"{{{name}}}", where.get(name, nowhere))
    text = text.replace("{second}", where.get("inner", _ELSEWHERE))
    _write_dbc_files(folder)
    file = folder / "stand.toml"
    file.write_text(f'name = "two axes"\n{text}\n{world}', "utf-8")
    return load_stand(file)


def _write_dbc_files(folder: Path) -> None:
    """The DBC file that comes along, with other identifiers for each DAQ."""
    text = (files("tumble.drivers.candaq") / "tumble_daq.dbc").read_text("utf-8")
    for place, axis in enumerate("xyz"):
        other = re.sub(r"\b7(68|8\d)\b", lambda found, by=32 * place: f"{int(found[0]) + by}", text)
        (folder / f"daq_{axis}.dbc").write_text(other, "utf-8")


def job_at(stand: LoadedStand, programme: str) -> Job:
    """A run of a triad there."""
    loaded = programme_from_text(programme, "p.toml") if "\n" in programme else load_programme(programme)
    return Job(stand=stand, programme=loaded, serial_number="E-1")
