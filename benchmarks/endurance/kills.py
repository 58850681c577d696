"""Kill -9 in the midst of runs, then resume: how many completed points are lost, and what becomes of the result.

`python -m benchmarks.endurance.kills [--count 200]` kills a `quick` run at every point boundary, a `seed` run at random
moments (spread evenly over the time that it takes), and as many of a `seed` run on a stand with drift, backlash and
flicker, which lives on for a whole dwell before the run goes on. Completed is what was on the disk when the process
died. Every resumed run is compared with the undisturbed one: with white noise alone, which is tied to the point, every
point and every parameter must be the same to the last bit; with drift every parameter must be within 0.1 standard
uncertainty.
"""

import argparse
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from benchmarks.endurance.killing import Job, kill_at, killed_after, undisturbed
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.recording.contents import Said, contents
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.messages import from_message
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.schemas import POINT
from tumble.procedures.steps import Point

DRIFT = """\
seed = 1
flicker_v = 1e-5
effects = { backlash = 0.002, bias_drift = 2e-3, scale_drift = 1e-3, bias_temperature = 5e-4, bias_random_walk = 1e-4 }
"""
"""Flicker of 10 µg: the bias of a measured triad wandered by 2.4 to 6 µg (Dzuev 2018: 1.0″ to 2.5″, twice sigma)."""
DRIFTING = Job(programme="seed", simulated=DRIFT, outage_s=1.0)
"""The outage is a dwell."""
AGREED = 0.1
"""Allowed difference of a parameter from the undisturbed run where the stand drifts, in standard uncertainties."""
TOGETHER = 2
"""Runs at the same time."""


@dataclass(frozen=True, kw_only=True)
class Undisturbed:
    """A run that nobody killed."""

    points: list[Point]
    parameters: dict[str, Parameter]
    duration_s: float
    """Once its recording was there."""


@dataclass(frozen=True, kw_only=True)
class Survived:
    """What became of one run that was killed."""

    points_before: int = 0
    """Completed when the process died."""
    lost: int = 0
    doubled: int = 0
    changed: int = 0
    """Points that are not those of the undisturbed run, but for their time and temperature."""
    off: float = 0.0
    """Greatest difference of a parameter from the undisturbed run, in standard uncertainties; 0 for the same bits."""
    failed: str = ""
    """What `resume` complained of."""


def points_said(path: Path) -> list[Point]:
    """Every message on `/point`, doubled ones included."""
    said = [entry for entry in contents(path, {POINT}) if isinstance(entry, Said)]
    points = [from_message(entry.topic, entry.data, LAYOUT) for entry in said]
    return [point for point in points if isinstance(point, Point)]


def fitted(recording: Path) -> dict[str, Parameter]:
    return dict(analyse(observations(read_recording(recording)), trials=0).parameters)


def measured(point: Point) -> Point:
    """A point without its time, a sum of floating-point numbers, and without the temperature at that time."""
    return replace(point, time_s=0.0, temperature_degc=None)


def greatest_difference(found: dict[str, Parameter], expected: dict[str, Parameter]) -> float:
    """Of all parameters, in standard uncertainties; infinite where one is told in one run only."""
    if any((found[name].value is None) != (expected[name].value is None) for name in expected):
        return float("inf")
    told = {name: one for name, one in expected.items() if one.value is not None}
    return max(abs(found[name].value - one.value) / one.standard_uncertainty for name, one in told.items())


def carried_out(job: Job, folder: Path) -> Undisturbed:
    """Run to the end."""
    recording = folder / "whole.mcap"
    duration_s = undisturbed(job, recording)
    return Undisturbed(points=points_said(recording), parameters=fitted(recording), duration_s=duration_s)


def resumed(recording: Path, job: Job, expected: Undisturbed) -> Survived:
    """Resume and compare with what was there before, and with the undisturbed run."""
    try:
        before = points_said(recording)
    except RecordingError:  # it died before its header was complete: there is nothing to lose yet
        return Survived()
    ran = job.resume(recording)
    if ran.returncode or not recording.exists():
        return Survived(points_before=len(before), lost=len(before), failed=ran.stderr.strip())
    said = Counter(point.index for point in points_said(recording))
    blocks = Counter(event.point for event in iter_samples(recording))
    kept = {point.index: point for point in read_recording(recording).points}
    whole = {point.index: measured(point) for point in expected.points}
    return Survived(
        points_before=len(before),
        lost=sum(kept.get(point.index) != point for point in before) + len(whole.keys() - kept.keys()),
        doubled=sum(count - 1 for counted in (said, blocks) for count in counted.values()),
        changed=sum(measured(kept[index]) != point for index, point in whole.items() if index in kept),
        off=greatest_difference(fitted(recording), expected.parameters),
    )


def at_boundaries(job: Job, every: int = 1) -> list[Survived]:
    """Kill at every point boundary, or at every n-th."""

    def kill(point: int, recording: Path, _: Undisturbed) -> None:
        kill_at(point, job, recording)

    return _survive(job, kill, lambda expected: range(0, len(expected.points), every))


def at_random(job: Job, count: int, seed: int, expected: Undisturbed | None = None) -> list[Survived]:
    """Kill at random moments; a run that was done before its moment is run again, with another one.

    `expected` is the undisturbed run, which is made where it is not given.
    """

    def kill(number: int, recording: Path, expected: Undisturbed) -> None:
        moments = random.Random(seed + number)
        while not killed_after(moments.uniform(0.0, expected.duration_s * TOGETHER), job, recording):
            recording.unlink()

    return _survive(job, kill, lambda _: range(count), expected)


def _survive(
    job: Job,
    kill: Callable[[int, Path, Undisturbed], None],
    numbers: Callable[[Undisturbed], Iterable[int]],
    expected: Undisturbed | None = None,
) -> list[Survived]:
    """Run, kill, resume and compare, for every number."""
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(TOGETHER) as pool:
        folder = Path(name)
        whole = expected or carried_out(job, folder)

        def survive(number: int) -> Survived:
            recording = folder / f"{number}.mcap"
            kill(number, recording, whole)
            return resumed(recording, job, whole)

        return list(pool.map(survive, numbers(whole)))


def summary(name: str, survived: list[Survived]) -> str:
    """A row of a Markdown table, and a line for every complaint."""
    totals = [sum(getattr(one, what) for one in survived) for what in ("points_before", "lost", "doubled", "changed")]
    row = f"| {name} | {len(survived)} | {' | '.join(map(str, totals))} | {max(one.off for one in survived):.2g} |"
    return "\n".join([row, *(f"  {one.failed}" for one in survived if one.failed)])


def safe(survived: list[Survived]) -> bool:
    """Whether nothing was lost or doubled, and every run went on."""
    return not any(one.lost or one.doubled or one.failed for one in survived)


def identical(survived: list[Survived]) -> bool:
    """Whether every point and every parameter has the same bits as in the undisturbed run."""
    return not any(one.changed or one.off for one in survived)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200, help="kills at random moments, on either stand")
    parser.add_argument("--every", type=int, default=1, help="every n-th point boundary of a quick run")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print("| run | kills | points completed before | lost | doubled | changed | greatest difference |")
    print("|---|---|---|---|---|---|---|")
    quick = at_boundaries(Job(programme="quick"), options.every)
    print(summary("`quick`, at point boundaries", quick), flush=True)
    seed = at_random(Job(programme="seed"), options.count, options.seed)
    print(summary("`seed`, at random moments", seed), flush=True)
    drifted = at_random(DRIFTING, options.count, options.seed)
    print(summary("`seed` with drift, backlash, flicker and an outage of a dwell", drifted))
    good = all(map(safe, (quick, seed, drifted))) and identical([*quick, *seed])
    return 0 if good and all(one.off <= AGREED for one in drifted) else 1


if __name__ == "__main__":
    sys.exit(main())
