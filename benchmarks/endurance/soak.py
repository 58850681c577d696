"""A thousand points through the wire while something goes wrong every few seconds: is the fit right, is nothing lost?

`python -m benchmarks.endurance.soak` measures five mounts four times on an emulated stand while faults are drawn at
random, at intervals that are exponential by the stand's clock. Most are such that a run goes on; where one stops it, as
a stall does, it is resumed, as an operator would. At the end the fit is held against what the stand simulates.
"""

import argparse
import math
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from threading import Event as Flag
from threading import Thread
from typing import Final

from benchmarks.endurance.emulated import EmulatedStand, Pair, emulated
from benchmarks.endurance.fault_runs import reached
from benchmarks.endurance.kills import points_said
from tumble.app.resuming import find, resume
from tumble.app.running import failure, run
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.drivers.simulated import Simulated
from tumble.emulators.faults import At, Fault, Kind
from tumble.procedures.events import Event, PointCompleted
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.outcome import Outcome
from tumble.procedures.recording.reader import iter_samples, read_recording

SPEED: Final = 10.0
EVERY_S: Final = 2.0
REALISATIONS: Final = 4
MOUNTS: Final = ("face-up", "face-down", "face-up-90", "edge", "end")
SWEEP: Final = """\

[[procedure]]
kind = "sweep"
mount = "{mount}"
step_deg = {step_deg}
points = {points}
"""
TRUE: Final = {"u0": 2.5, "kx": 1.0, "ky": 0.0098, "kz": 0.002, "kxy": 0.001, "alpha0": 0.1121}
_MOST_RESUMES: Final = 50
_LOOK_S: Final = 0.02

Draw = tuple[str, Kind, float, int]
"""Device, fault, how long at most in real seconds, and how often among the others."""

_OF_LINES: Final[tuple[Draw, ...]] = tuple(
    (device, kind, 1.2, 4)
    for device in ("head", "daq")
    for kind in ("late", "cut", "double", "garble", "reorder", "wrong_checksum")
)
_OF_ALL: Final[tuple[Draw, ...]] = (
    *_OF_LINES,
    ("head", "drop", 0.3, 4),
    ("daq", "drop", 0.3, 4),
    ("head", "power_loss", 0.2, 2),
    ("daq", "power_loss", 0.2, 2),
    ("daq", "nan", 0.0, 2),
    ("daq", "overload", 0.0, 2),
    ("head", "stall", 0.0, 1),
)
DRAWS: Final[dict[Pair, tuple[Draw, ...]]] = {
    "serial": (*_OF_ALL, ("daq", "error_queued", 0.0, 4)),
    "CAN": (
        *_OF_ALL,
        ("daq", "frames_lost", 0.0, 4),
        ("daq", "bus_off", 0.2, 2),
        ("head", "bus_off", 0.2, 2),
        ("head", "heartbeat_lost", 2.0, 1),
        ("head", "emergency", 0.0, 1),
    ),
}


@dataclass(frozen=True, kw_only=True)
class Soaked:
    """What came of it."""

    pair: Pair
    points: int
    planned: int
    lost: int
    doubled: int
    set_aside: int
    happened: Counter[str]
    resumes: int
    errors: dict[str, float]
    """Fitted minus true value of every parameter, in standard uncertainties."""
    growth_mb: float
    """Of the resident memory of this process, emulators included, from a tenth of the points to the last."""
    resident_mb: float
    stand_s: float
    real_s: float

    @property
    def good(self) -> bool:
        """Whether nothing is lost and everything agrees with the truth."""
        whole = self.points == self.planned and not self.lost and not self.doubled
        return whole and all(abs(error) <= 3.0 for error in self.errors.values())


@dataclass
class Watch:
    """A listener that counts, and looks at the memory."""

    planned: int
    completed: list[int] = field(default_factory=list)
    early_mb: float = 0.0

    def __call__(self, event: Event) -> None:
        """Note a point."""
        if isinstance(event, PointCompleted):
            self.completed.append(event.point.index)
            if len(self.completed) == max(self.planned // 10, 1):
                self.early_mb = resident_mb()


def resident_mb() -> float:
    """Memory that this process has now; the most it ever had where the system does not say."""
    statm = Path("/proc/self/statm")
    if statm.exists():
        return int(statm.read_text().split()[1]) * 4096 / 1e6
    if sys.platform == "win32":
        return 0.0
    import resource  # not on Windows

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def programme(points: int, realisations: int) -> str:
    """A turn of so many points in each of the five mounts, so many times."""
    sweeps = (SWEEP.format(mount=mount, points=points, step_deg=360.0 / points) for mount in MOUNTS)
    return f'name = "soak"\nrealisations = {realisations}\nsettle_s = 0.1\n' + "".join(sweeps)


@contextmanager
def misfortune(stand: EmulatedStand, pair: Pair, seed: int, every_s: float) -> Iterator[None]:
    """Have something go wrong every few seconds of the stand while the context lasts, one thing at a time.

    The next is drawn when the last has happened and is over: drivers wait for answers in real time, in which a stand
    that runs faster would otherwise heap fault upon fault.
    """
    random, over = Random(seed), Flag()
    draws = DRAWS[pair]
    often = [draw[3] for draw in draws]

    def strike() -> None:
        while not over.wait(random.expovariate(1.0 / every_s) / stand.speed):
            ((device, kind, most_s, _),) = random.choices(draws, often)
            lasts_s, before = random.uniform(0.0, most_s), len(stand.faults.happened)
            fault = {"device": device, "kind": kind, "lasts_s": lasts_s, "at": At(time_s=0.0)}
            stand.faults.add(Fault.model_validate(fault))
            while len(stand.faults.happened) == before and not over.wait(_LOOK_S):
                pass
            over.wait(lasts_s)

    thread = Thread(target=strike, name="misfortune", daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


def _world(seed: int) -> Simulated:
    given = {"alpha0_deg" if name == "alpha0" else name: true for name, true in TRUE.items()}
    return Simulated.model_validate({"seed": seed, "parameters": given})


def measured(stand: EmulatedStand, recording: Path, watch: Watch) -> int:
    """Run to the end of the programme, resuming whenever something stops the run; return how often."""
    resumes = -1
    while resumes < _MOST_RESUMES:
        resumes += 1
        outcome = _one_go(stand, recording, watch, resumes > 0)
        error = failure(outcome, recording)
        if error is None:
            break
        print(f"resuming: {error}", file=sys.stderr)
    return resumes


def _one_go(stand: EmulatedStand, recording: Path, watch: Watch, again: bool) -> Outcome:
    connected = reached(stand)
    try:
        if again:
            return resume(find(recording), stand.job, connected, [watch])
        return run(stand.job, connected, recording, [watch])
    finally:
        connected.links.close()


def soak(
    folder: Path,
    pair: Pair,
    points: int,
    *,
    realisations: int = REALISATIONS,
    speed: float = SPEED,
    every_s: float = EVERY_S,
    seed: int = 1,
) -> Soaked:
    """Measure so many points a sweep with one pair of instruments."""
    recording, began_s = folder / "run.mcap", time.monotonic()
    with emulated(folder, pair, programme(points, realisations), speed, _world(seed)) as stand:
        watch = Watch(planned=stand.job.plan().dwells)
        with misfortune(stand, pair, seed, every_s):
            resumes = measured(stand, recording, watch)
        growth_mb, stand_s = resident_mb() - watch.early_mb, stand.clock.monotonic_s()
        happened = Counter(f"{fault.device} {fault.kind}" for _, fault in stand.faults.happened)
    real_s = time.monotonic() - began_s
    kept = Counter(point.index for point in points_said(recording))
    blocks = Counter(event.point for event in iter_samples(recording))
    rows = observations(read_recording(recording))
    parameters = analyse(rows).parameters
    return Soaked(
        pair=pair,
        points=len(kept),
        planned=watch.planned,
        lost=sum(index not in kept for index in watch.completed),
        doubled=sum(count - 1 for counted in (kept, blocks) for count in counted.values()),
        set_aside=len(rows.set_aside),
        happened=happened,
        resumes=resumes,
        errors={name: _error(parameters[name], true) for name, true in TRUE.items()},
        growth_mb=growth_mb,
        resident_mb=resident_mb(),
        stand_s=stand_s,
        real_s=real_s,
    )


def _error(parameter: Parameter, true: float) -> float:
    """Fitted minus true value in standard uncertainties; infinite where there is none."""
    if parameter.value is None or not parameter.standard_uncertainty:
        return math.inf
    return (parameter.value - true) / parameter.standard_uncertainty


def summary(soaked: Soaked) -> str:
    """What came of it, in Markdown."""
    errors = ", ".join(f"{name} {error:+.1f}" for name, error in soaked.errors.items())
    happened = ", ".join(f"{count} {what}" for what, count in soaked.happened.most_common())
    return (
        f"{soaked.pair}: {soaked.points} of {soaked.planned} points, {soaked.lost} lost, {soaked.doubled} doubled, "
        f"{soaked.set_aside} set aside (NaN, overload); {soaked.happened.total()} faults in {soaked.stand_s:.0f} s of "
        f"the stand ({soaked.real_s:.0f} s real), {soaked.resumes} of them stopped the run, which was resumed; fitted "
        f"minus true in standard uncertainties: {errors}; resident memory grew by {soaked.growth_mb:.1f} MB to "
        f"{soaked.resident_mb:.0f} MB\n\nFaults: {happened}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=50, help="of each of twenty sweeps")
    parser.add_argument("--speed", type=float, default=SPEED, help="of the stand, times real time")
    parser.add_argument("--every-s", type=float, default=EVERY_S, help="mean time between faults, by the stand's clock")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pair", choices=list(DRAWS), action="append", help="both without")
    options = parser.parse_args()
    good = True
    for pair in options.pair or list(DRAWS):
        with tempfile.TemporaryDirectory() as name:
            soaked = soak(
                Path(name), pair, options.points, speed=options.speed, every_s=options.every_s, seed=options.seed
            )
        print(summary(soaked), end="\n\n", flush=True)
        good = good and soaked.good
    if not good:
        sys.exit("something was lost, doubled, or does not agree with the truth")


if __name__ == "__main__":
    main()
