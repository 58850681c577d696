"""Kill -9 in runs of a triad at two temperatures: after every point, and in the midst of every soak. POSIX only.

`python -m benchmarks.endurance.two_axes_kills [--emulated]` kills a run of the stand in the process, or of one that is
served by `tumble emulate`, resumes it and compares: completed points lost, doubled, or with other readings than those
of the run that nobody killed.
"""

import argparse
import json
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from benchmarks.endurance.processes import TUMBLE
from benchmarks.endurance.two_axes import CHAMBER, SCANNER, SIMULATED, SIMULATED_CHAMBER, WORLD, ZABER
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.steps import Point

PROGRAMME: Final = """method = "triad"
name = "kills"
temperatures_degC = [25, 24]
settle_s = 0.1
settle_tolerance_v = 1.0

[soak]
window_s = 48.0
look_s = 12.0
rate_K_per_h = 1000.0

[[procedure]]
positions = [[90, 0], [0, 90], [-45, 45]]
"""
POINTS: Final = 6
SOAKS: Final = 2
_SPEED: Final = 40.0
_KILLING: Final = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.writer import Recorder
from tumble.procedures.soaking import Soaking

what, last = sys.argv.pop(1), int(sys.argv.pop(1))
record, note, carry_out = Recorder.record, Soaking._note, Soaking.carry_out
soaks = looks = 0

def die():
    os.kill(os.getpid(), signal.SIGKILL)

def record_and_die(recorder, event):
    record(recorder, event)
    if what == "point" and isinstance(event, PointCompleted) and event.point.index == last:
        die()

def count_and_carry_out(soaking, setpoint_degc):
    global soaks
    soaks += 1
    return carry_out(soaking, setpoint_degc)

def note_and_die(soaking, status):
    global looks
    note(soaking, status)
    looks += soaks == last + 1
    if what == "soak" and looks == 3:
        die()

Recorder.record, Soaking._note, Soaking.carry_out = record_and_die, note_and_die, count_and_carry_out
main()
"""


@dataclass(frozen=True, kw_only=True)
class Killed:
    """A run that was killed and resumed."""

    what: str
    """`point` or `soak`."""
    number: int
    lost: int
    doubled: int
    changed: int
    """Points whose readings are others than in the run that nobody killed."""


@contextmanager
def in_process(folder: Path) -> Iterator[Path]:
    """The stand file of a stand in the process of the run."""
    yield _written(folder, f"{SIMULATED}\n{SIMULATED_CHAMBER}", {})


@contextmanager
def emulated(folder: Path) -> Iterator[Path]:
    """The stand file of a stand that a process of its own serves."""
    tables = "\n".join((ZABER, SCANNER, CHAMBER))
    anywhere = _written(folder, tables, {})
    command = [*TUMBLE, "emulate", "--stand", str(anywhere), "--speed", f"{_SPEED}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield _written(folder, tables, json.loads(process.stdout.readline()))
        finally:
            process.send_signal(signal.SIGTERM)


def _written(folder: Path, tables: str, where: Mapping[str, str]) -> Path:
    text = tables
    for name in ("outer", "inner", "scanner", "chamber"):
        text = text.replace(f"{{{name}}}", where.get(name, "socket://127.0.0.1:0"))
    (folder / "programme.toml").write_text(PROGRAMME, "utf-8")
    path = folder / "stand.toml"
    path.write_text(f'name = "kills"\n{text}\n{WORLD}', "utf-8")
    return path


def whole_run(stand: Path, recording: Path) -> tuple[Point, ...]:
    """The points of a run that nobody kills."""
    _check(subprocess.run([*TUMBLE, *_run(stand, recording)], capture_output=True, check=False), 0)
    return read_recording(recording).points


def killed(stand: Path, recording: Path, what: str, number: int, whole: tuple[Point, ...]) -> Killed:
    """Kill a run after a point, or in a soak, resume it, and compare."""
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
    moments = [("point", number) for number in range(POINTS - 1)] + [("soak", number) for number in range(SOAKS)]
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
