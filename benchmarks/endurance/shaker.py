"""Emulated shakers in this process, reached by the real drivers through loopback sockets: a generator, two meters."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from tumble.app.running import Job
from tumble.app.simulation import simulation
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.wiring import Connected, connect
from tumble.drivers.simulated.exciter import SimulatedExciter
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.faults import At, Fault, Kind
from tumble.emulators.speed import FasterClock
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.procedures.programmes import programme_from_text

LIMITS: Final = """level_limit_g = 12.0
frequency_limits_Hz = [5.0, 500.0]
ramp_s = 1.6
references = { reference_x_v = 0.1 }
"""
GENERATOR: Final = f"""[exciter]
driver = "generator"
url = "{{exciter}}"
{LIMITS}
[exciter.outputs]
x = {{ channel = 1, g_per_v = 2.0 }}
"""
SIMULATED_EXCITER: Final = f'[exciter]\ndriver = "simulated"\n{LIMITS}'
_SAMPLING: Final = "samples = 200\nrate_hz = 250.0\n"
METERS: Final = "\n".join(
    f'[samplers.{name}]\ndriver = "scpi"\nurl = "{{{name}}}"\nchannels = ["{channel}"]\n{_SAMPLING}'
    for name, channel in (("unit", "output_v"), ("reference", "reference_x_v"))
)
"""A digitising meter for the unit, one for the reference."""
SIMULATED_METER: Final = f'[samplers.unit]\ndriver = "simulated"\nchannels = ["output_v", "reference_x_v"]\n{_SAMPLING}'
WORLD: Final = """[simulated]
world = "vibration"
seed = 4
noise_ug = 300.0
frequency_error = 0.002
parameters = { k_ii = 220.0, bias = 400.0 }
temperature = { wander_K = 0.0 }
"""
SHORT: Final = """method = "vibration"
name = "short"
settle_s = 0.1
settle_samples = 20

[[procedure]]
levels_g = [5.0]
frequencies_Hz = [21.3]
"""
_NAMES: Final = ("exciter", "unit", "reference")


@dataclass(frozen=True, kw_only=True)
class ShakerStand:
    """A stand being served, and what is to be measured there."""

    job: Job
    clock: FasterClock
    shared: SharedWorld
    faults: StandFaults

    @property
    def exciter(self) -> SimulatedExciter:
        """What is true of the shaker."""
        exciter: SimulatedExciter = self.shared.world.exciter
        return exciter

    def suffer(self, kind: Kind, at: At, lasts_s: float = 1.0, device: str = "exciter") -> None:
        """Have something go wrong."""
        self.faults.add(Fault(device=device, kind=kind, at=at, lasts_s=lasts_s))

    @contextmanager
    def connected(self) -> Iterator[Connected]:
        """The real drivers. Raises `DeviceError`."""
        made = connect(self.job.stand, clock=self.clock)
        try:
            yield made
        finally:
            made.links.close()


@contextmanager
def served(
    folder: Path,
    instruments: str = f"{GENERATOR}\n{METERS}",
    programme: str = SHORT,
    speed: float = 10.0,
    world: str = WORLD,
) -> Iterator[ShakerStand]:
    """Serve a stand of these tables while the context lasts; `programme` is TOML."""
    clock = FasterClock(speed)
    anywhere = load_stand(written(folder, instruments, {}, programme, world))
    simulated = simulation(anywhere, clock)
    shared = SharedWorld(simulated)
    faults = StandFaults(None, clock, lambda: simulated.world.counts.dwells)
    file = anywhere.file
    wanted = Wanted(samplers=file.samplers, exciter=file.exciter_table, folder=folder, meter="34465A")
    with ExitStack() as stack:
        addresses = emulate(stack, shared, wanted, faults)
        stand = load_stand(written(folder, instruments, addresses, programme, world))
        yield ShakerStand(job=job_at(stand, programme), clock=clock, shared=shared, faults=faults)


def written(
    folder: Path, instruments: str, where: Mapping[str, str], programme: str = SHORT, world: str = WORLD
) -> Path:
    """The stand file with the addresses of its instruments, by name; the programme lies beside it."""
    text = instruments
    for name in _NAMES:
        text = text.replace(f"{{{name}}}", where.get(name, "socket://127.0.0.1:0"))
    (folder / "programme.toml").write_text(programme, "utf-8")
    path = folder / "stand.toml"
    path.write_text(f'name = "shaker"\n{text}\n{world}', "utf-8")
    return path


def job_at(stand: LoadedStand, programme: str = SHORT) -> Job:
    """A run of a unit there."""
    return Job(stand=stand, programme=programme_from_text(programme, "p.toml"), serial_number="V-1")
