"""Kill -9 in the midst of runs, then resume: how many completed points are lost, how many are doubled.

`python -m benchmarks.endurance.kills` kills a `quick` run at every point boundary, and a `seed` run at random moments
(`--count`, spread evenly in probability over the time that an undisturbed run takes). Completed is what was on the disk
when the process died. Every resumed run is also compared with the undisturbed one, voltage by voltage.
"""

import argparse
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from procedures.recording.contents import Said, contents
from procedures.recording.errors import RecordingError
from procedures.recording.messages import from_message
from procedures.recording.reader import iter_samples, read_recording
from procedures.recording.schemas import POINT
from procedures.steps import Point

TUMBLE = (sys.executable, "-m", "app")
AT_BOUNDARY = """\
import os, signal, sys
from app.cli import main
from procedures.events import PointCompleted
from procedures.recording.writer import Recorder

last, record = int(sys.argv.pop(1)), Recorder.record

def record_and_die(recorder, event):
    record(recorder, event)
    if isinstance(event, PointCompleted) and event.point.index == last:
        os.kill(os.getpid(), signal.SIGKILL)

Recorder.record = record_and_die
main()
"""
TOGETHER = 2
"""Runs at the same time."""


@dataclass(frozen=True, kw_only=True)
class Survived:
    """What became of one run."""

    killed: bool
    points_before: int
    """Completed when the process died."""
    lost: int
    doubled: int
    changed: int
    """Points whose voltage is not the one of the undisturbed run."""
    failed: str = ""
    """What `resume` complained of."""


def points_said(path: Path) -> list[Point]:
    """Every message on `/point`, doubled ones included."""
    said = [entry for entry in contents(path, {POINT}) if isinstance(entry, Said)]
    points = [from_message(entry.topic, entry.data) for entry in said]
    return [point for point in points if isinstance(point, Point)]


def job(programme: str, recording: Path) -> list[str]:
    return ["run", "--programme", programme, "--serial", "kills", "--out", str(recording)]


def killed_at(point: int, programme: str, recording: Path) -> bool:
    """Run until a point is completed and die there."""
    command = [sys.executable, "-c", AT_BOUNDARY, str(point), *job(programme, recording)]
    return subprocess.run(command, stderr=subprocess.DEVNULL, check=False).returncode != 0


def killed_after(moment_s: float, programme: str, recording: Path) -> bool:
    """Run until a moment after the recording has appeared, and kill; false where the run was done before."""
    with subprocess.Popen([*TUMBLE, *job(programme, recording)], stderr=subprocess.DEVNULL) as process:
        while process.poll() is None and not recording.exists():
            time.sleep(0.001)
        time.sleep(moment_s)
        process.kill()
        return process.wait() != 0


def resumed(recording: Path, expected: list[Point], killed: bool) -> Survived:
    """Resume and compare with what was there before, and with the undisturbed run."""
    try:
        before = points_said(recording)
    except RecordingError:  # it died before its header was complete: there is nothing to lose yet
        return Survived(killed=killed, points_before=0, lost=0, doubled=0, changed=0)
    ran = subprocess.run([*TUMBLE, "resume", str(recording)], capture_output=True, text=True, check=False)
    after = Counter(point.index for point in points_said(recording)) if recording.exists() else Counter()
    blocks = Counter(event.point for event in iter_samples(recording)) if recording.exists() else Counter()
    kept = {point.index: point for point in read_recording(recording).points} if recording.exists() else {}
    return Survived(
        killed=killed,
        points_before=len(before),
        lost=sum(kept.get(point.index) != point for point in before) + (len(expected) - len(kept)),
        doubled=sum(count - 1 for counted in (after, blocks) for count in counted.values()),
        changed=sum(kept[p.index].voltage_v != p.voltage_v for p in expected if p.index in kept),
        failed="" if ran.returncode == 0 else ran.stderr.strip(),
    )


def undisturbed(programme: str, folder: Path) -> tuple[list[Point], float]:
    """Points of a run that nobody kills, and how long it takes once its recording is there."""
    recording = folder / f"{programme}-whole.mcap"
    with subprocess.Popen([*TUMBLE, *job(programme, recording)], stderr=subprocess.DEVNULL) as process:
        while process.poll() is None and not recording.exists():
            time.sleep(0.001)
        began_s = time.monotonic()
        process.wait()
    return points_said(recording), time.monotonic() - began_s


def at_boundaries(folder: Path, programme: str = "quick", every: int = 1) -> list[Survived]:
    """Kill at every point boundary, or at every n-th."""
    expected, _ = undisturbed(programme, folder)

    def survive(point: int) -> Survived:
        recording = folder / f"boundary-{point}.mcap"
        return resumed(recording, expected, killed_at(point, programme, recording))

    with ThreadPoolExecutor(TOGETHER) as pool:
        return list(pool.map(survive, range(0, len(expected), every)))


def at_random(folder: Path, count: int, seed: int, programme: str = "seed") -> list[Survived]:
    """Kill at random moments."""
    expected, duration_s = undisturbed(programme, folder)
    moments_s = [random.Random(seed + number).uniform(0.0, duration_s * TOGETHER) for number in range(count)]

    def survive(number: int) -> Survived:
        recording = folder / f"random-{number}.mcap"
        return resumed(recording, expected, killed_after(moments_s[number], programme, recording))

    with ThreadPoolExecutor(TOGETHER) as pool:
        return list(pool.map(survive, range(count)))


def summary(name: str, all_survived: list[Survived]) -> str:
    """One line, and one for every complaint."""
    killed = sum(one.killed for one in all_survived)
    totals = {what: sum(getattr(one, what) for one in all_survived) for what in ("lost", "doubled", "changed")}
    before = sum(one.points_before for one in all_survived)
    said = ", ".join(f"{count} {what}" for what, count in totals.items())
    complaints = [f"  {one.failed}" for one in all_survived if one.failed]
    return "\n".join([f"{name}: {killed} kills, {before} points completed before them: {said}", *complaints])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10, help="kills of a seed run at random moments")
    parser.add_argument("--every", type=int, default=1, help="every n-th point boundary of a quick run")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        boundaries = at_boundaries(Path(name), every=options.every)
        print(summary("quick, at point boundaries", boundaries), flush=True)
        moments = at_random(Path(name), options.count, options.seed)
        print(summary("seed, at random moments", moments))
    if any(one.lost or one.doubled or one.failed for one in (*boundaries, *moments)):
        sys.exit(1)


if __name__ == "__main__":
    main()
