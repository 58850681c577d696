"""Kill -9 in runs on a shaker: after every point, on every ramp, and in every dwell. POSIX only.

`python -m benchmarks.endurance.shaker_kills [--emulated]` kills a run of the stand in the process, or of one that is
served by `tumble emulate` (where the generator then goes on driving), resumes it and compares: completed points lost,
doubled, or with other readings than those of the run that nobody killed.
"""

import argparse
import json
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from benchmarks.endurance.processes import TUMBLE
from benchmarks.endurance.shaker import GENERATOR, METERS, SIMULATED_EXCITER, SIMULATED_METER, written
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.steps import Point

PROGRAMME: Final = """method = "vibration"
name = "kills"
settle_s = 0.1
settle_samples = 20

[[procedure]]
levels_g = [3.0, 5.0]
frequencies_Hz = [21.3]
mountings = [{}, { x = "o", y = "p" }]
"""
POINTS: Final = 10
RAMPS: Final = 4
_SPEED: Final = 20.0
_KILLING: Final = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted, SamplesAcquired
from tumble.procedures.exciters import Exciters
from tumble.procedures.recording.writer import Recorder

what, last = sys.argv.pop(1), int(sys.argv.pop(1))
record, raise_to = Recorder.record, Exciters._set
levels = 0

def die():
    os.kill(os.getpid(), signal.SIGKILL)

def record_and_die(recorder, event):
    record(recorder, event)
    if what == "point" and isinstance(event, PointCompleted) and event.point.index == last:
        die()
    if what == "dwell" and isinstance(event, SamplesAcquired) and event.point == last:
        die()

def set_and_die(exciters, name, level):
    global levels
    levels += 1
    raise_to(exciters, name, level)
    if what == "ramp" and levels == 15 * last + 5:  # eight steps up, seven down
        die()

Recorder.record, Exciters._set = record_and_die, set_and_die
main()
"""


@dataclass(frozen=True, kw_only=True)
class Killed:
    """A run that was killed and resumed."""

    what: str
    """`point`, `dwell` or `ramp`."""
    number: int
    lost: int
    doubled: int
    changed: int
    """Points whose readings are others than in the run that nobody killed."""


@contextmanager
def in_process(folder: Path) -> Iterator[Path]:
    """The stand file of a stand in the process of the run."""
    yield written(folder, f"{SIMULATED_EXCITER}\n{SIMULATED_METER}", {}, PROGRAMME)


@contextmanager
def emulated(folder: Path) -> Iterator[Path]:
    """The stand file of a stand that a process of its own serves."""
    tables = f"{GENERATOR}\n{METERS}"
    anywhere = written(folder, tables, {}, PROGRAMME)
    command = [*TUMBLE, "emulate", "--stand", str(anywhere), "--speed", f"{_SPEED}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield written(folder, tables, json.loads(process.stdout.readline()), PROGRAMME)
        finally:
            process.send_signal(signal.SIGTERM)


def whole_run(stand: Path, recording: Path) -> tuple[Point, ...]:
    """The points of a run that nobody kills."""
    _check(subprocess.run([*TUMBLE, *_run(stand, recording)], capture_output=True, check=False), 0)
    return read_recording(recording).points


def killed(stand: Path, recording: Path, what: str, number: int, whole: tuple[Point, ...]) -> Killed:
    """Kill a run after a point, in a dwell or on a ramp, resume it, and compare."""
    command = [sys.executable, "-c", _KILLING, what, str(number), *_run(stand, recording)]
    _check(subprocess.run(command, capture_output=True, check=False), -signal.SIGKILL)
    before = {point.index for point in read_recording(recording).points}
    _check(subprocess.run([*TUMBLE, "resume", str(recording)], capture_output=True, check=False), 0)
    points = read_recording(recording).points
    kept = Counter(point.index for point in points)
    changed = sum(_readings(point) != _readings(whole[point.index]) for point in points)
    lost = sum(index not in kept for index in {*before, *range(len(whole))})
    return Killed(what=what, number=number, lost=lost, doubled=sum(kept.values()) - len(kept), changed=changed)


def _readings(point: Point) -> dict[str, float]:
    return {name: reading.mean for name, reading in point.readings.items()}


def _run(stand: Path, recording: Path) -> list[str]:
    programme = stand.with_name("programme.toml")
    where = ["--programme", str(programme), "--stand", str(stand)]
    return ["run", *where, "--serial", "kills", "--out", str(recording)]


def _check(done: "subprocess.CompletedProcess[bytes]", wanted: int) -> None:
    if done.returncode != wanted:
        raise RuntimeError(f"status {done.returncode} in place of {wanted}: {done.stderr.decode()[-500:]}")


def main() -> None:
    """Kill at all of them, and say what became of the points."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--emulated", action="store_true")
    served = emulated if parser.parse_args().emulated else in_process
    moments = [("point", number) for number in range(POINTS - 1)]
    moments += [("dwell", number) for number in range(POINTS)] + [("ramp", number) for number in range(RAMPS)]
    with tempfile.TemporaryDirectory() as name, served(Path(name)) as stand:
        folder = Path(name)
        whole = whole_run(stand, folder / "whole.mcap")
        results = []
        for what, number in moments:
            results.append(killed(stand, folder / f"{what}{number}.mcap", what, number, whole))
            print(results[-1], flush=True)
    lost, doubled = sum(each.lost for each in results), sum(each.doubled for each in results)
    print(f"{len(results)} kills: lost {lost}, doubled {doubled}, changed {sum(each.changed for each in results)}")


if __name__ == "__main__":
    main()
