"""Stands with a gyro platform: the examples of the documents, emulated in this process and reached by real drivers."""

import re
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from tumble.app.running import Job
from tumble.app.simulation import simulation
from tumble.app.stand import LoadedStand, load_stand
from tumble.app.wiring import connect
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.faults import FaultScript
from tumble.emulators.speed import FasterClock
from tumble.emulators.stand_faults import StandFaults
from tumble.emulators.world import SharedWorld
from tumble.procedures.programmes import programme_from_text

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
QUIET = """[simulated]
world = "gyro_platform"
seed = 4
noise = { angle_random_walk_deg_sqrt_h = 0.0 }
azimuth_noise = { angle_random_walk_deg_sqrt_h = 0.0 }
tilt_noise_deg = 0.0
temperature = { wander_K = 0.0, sensor_noise_K = 0.0 }
"""
SIMULATED = """name = "here"
[site]
latitude_deg = 50.45
[positioners.azimuth]
driver = "simulated"
limits_deg = [-10.0, 370.0]
steps_per_deg = 3600.0
speed_deg_s = 9.0
[samplers.platform]
driver = "simulated"
samples = 20
rate_hz = 10.0
"""
SHORT = """method = "gyrocompass"
name = "short"
dwell_s = 2.0
settle_s = 7.0

[[procedure]]
positions = "0/90/180"
"""


@dataclass(frozen=True, kw_only=True)
class GyroStand:
    """A stand being served, and what is to be measured there."""

    job: Job
    clock: FasterClock
    shared: SharedWorld
    faults: StandFaults

    def connect(self):
        return connect(self.job.stand, clock=self.clock)


def written(folder, text, world=QUIET) -> LoadedStand:
    """A stand of these tables, with its DBC file beside it."""
    text = re.sub(r"^\[simulated\].*", "", text, flags=re.MULTILINE | re.DOTALL)
    (folder / "gyro-platform.dbc").write_bytes((EXAMPLES / "gyro-platform.dbc").read_bytes())
    (folder / "stand.toml").write_text(f"{text}\n{world}", "utf-8")
    return load_stand(folder / "stand.toml")


def job_at(stand, programme=SHORT):
    return Job(stand=stand, programme=programme_from_text(programme, "p.toml"), serial_number="G-1")


@contextmanager
def served(folder, example, *faults, programme=SHORT, speed=30.0, world=QUIET, change=lambda text: text):
    """Serve an example of the documents, `gyro-lines` or `gyro-can`; every fault needs `device`, `kind` and `at`."""
    text = change((EXAMPLES / f"{example}.toml").read_text("utf-8"))
    anywhere = written(folder, text, world)
    clock = FasterClock(speed)
    simulated = simulation(anywhere, clock)
    shared = SharedWorld(simulated)
    told = StandFaults(FaultScript.model_validate({"fault": faults}), clock, lambda: simulated.world.counts.dwells)
    wanted = Wanted(positioners=anywhere.file.positioners, samplers=anywhere.file.samplers, folder=folder)
    with ExitStack() as stack:
        for name, address in emulate(stack, shared, wanted, told).items():
            table = f"[{'positioners' if name == 'azimuth' else 'samplers'}.{name}]"
            head, tail = text.split(table)
            text = head + table + re.sub(r'^url = ".*"', f'url = "{address}"', tail, count=1, flags=re.MULTILINE)
        yield GyroStand(job=job_at(written(folder, text, world), programme), clock=clock, shared=shared, faults=told)
