"""An emulated shaker in this process: generator and meters, reached by the real drivers through loopback sockets."""

from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

from tumble.app.running import Job
from tumble.app.simulation import simulation
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.faults import At, Fault
from tumble.emulators.speed import FasterClock
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.procedures.programmes import programme_from_text

LIMITS = """level_limit_g = 12.0
frequency_limits_Hz = [5.0, 500.0]
ramp_s = 1.6
references = { reference_x_v = 0.1 }
"""
GENERATOR = f"""[exciter]
driver = "generator"
url = "{{exciter}}"
{LIMITS}
[exciter.outputs]
x = {{ channel = 1, g_per_v = 2.0 }}
"""
SIMULATED_EXCITER = f'[exciter]\ndriver = "simulated"\n{LIMITS}'
SAMPLING = "samples = 200\nrate_hz = 250.0\n"
METERS = "\n".join(
    f'[samplers.{name}]\ndriver = "scpi"\nurl = "{{{name}}}"\nchannels = ["{channel}"]\n{SAMPLING}'
    for name, channel in (("unit", "output_v"), ("reference", "reference_x_v"))
)
SIMULATED_METER = f'[samplers.unit]\ndriver = "simulated"\nchannels = ["output_v", "reference_x_v"]\n{SAMPLING}'
WORLD = """[simulated]
world = "vibration"
seed = 4
noise_ug = 300.0
frequency_error = 0.002
parameters = { k_ii = 220.0, bias = 400.0 }
temperature = { wander_K = 0.0 }
"""
SHORT = """method = "vibration"
name = "short"
settle_s = 0.1
settle_samples = 20

[[procedure]]
levels_g = [5.0]
frequencies_Hz = [21.3]
"""


@dataclass(frozen=True, kw_only=True)
class ShakerStand:
    """A stand being served, and what is to be measured there."""

    job: Job
    clock: FasterClock
    shared: SharedWorld
    faults: StandFaults

    @property
    def exciter(self):
        """What is true of the shaker."""
        return self.shared.world.exciter

    def suffer(self, kind, lasts_s=1.0, device="exciter", **at):
        """Have something go wrong."""
        self.faults.add(Fault(device=device, kind=kind, at=At(**at), lasts_s=lasts_s))

    @contextmanager
    def connected(self):
        """The real drivers."""
        made = connect(self.job.stand, clock=self.clock)
        try:
            yield made
        finally:
            made.links.close()


def stand_of(folder, instruments, where, world=WORLD):
    """The stand whose instruments have these addresses, by their names."""
    text = instruments
    for name in ("exciter", "unit", "reference"):
        text = text.replace(f"{{{name}}}", where.get(name, "socket://127.0.0.1:0"))
    file = folder / "stand.toml"
    file.write_text(f'name = "shaker"\n{text}\n{world}', "utf-8")
    return load_stand(file)


def job_at(stand, programme=SHORT):
    """A run of a unit there."""
    return Job(stand=stand, programme=programme_from_text(programme, "p.toml"), serial_number="V-1")


@contextmanager
def served(folder, instruments=f"{GENERATOR}\n{METERS}", programme=SHORT, speed=10.0, world=WORLD):
    """Serve a stand of these tables while the context lasts."""
    clock = FasterClock(speed)
    anywhere = stand_of(folder, instruments, {}, world)
    simulated = simulation(anywhere, clock)
    shared = SharedWorld(simulated)
    faults = StandFaults(None, clock, lambda: simulated.world.counts.dwells)
    file = anywhere.file
    wanted = Wanted(samplers=file.samplers, exciter=file.exciter_table, folder=folder, meter="34465A")
    with ExitStack() as stack:
        stand = stand_of(folder, instruments, emulate(stack, shared, wanted, faults), world)
        yield ShakerStand(job=job_at(stand, programme), clock=clock, shared=shared, faults=faults)
