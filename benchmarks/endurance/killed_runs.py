"""Runs that are killed at a moment of their own, resumed and compared; each stand brings its moments. POSIX only.

A moment is written as a script: it takes what to be killed in and a number from the command line, sets that up, and
carries out the rest of the command line as `tumble` does.
"""

import argparse
import json
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path

from benchmarks.endurance.processes import TUMBLE
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.steps import Point


@dataclass(frozen=True, kw_only=True)
class Killed:
    """A run that was killed and resumed."""

    what: str
    """In what it was killed: `point`, `soak`, `ramp` or the like."""
    number: int
    lost: int
    doubled: int
    changed: int
    """Points whose readings are others than in the run that nobody killed."""


@contextmanager
def served(written: Callable[[Mapping[str, str]], Path], speed: float) -> Iterator[Path]:
    """The stand file of a stand that a process of its own serves; `written` writes it with the addresses."""
    command = [*TUMBLE, "emulate", "--stand", str(written({})), "--speed", f"{speed}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield written(json.loads(process.stdout.readline()))
        finally:
            process.send_signal(signal.SIGTERM)


def whole_run(stand: Path, recording: Path) -> tuple[Point, ...]:
    """The points of a run that nobody kills."""
    _check(subprocess.run([*TUMBLE, *_run(stand, recording)], capture_output=True, check=False), 0)
    return read_recording(recording).points


def killed(script: str, stand: Path, recording: Path, what: str, number: int, whole: Sequence[Point]) -> Killed:
    """Kill a run at a moment, resume it, and compare."""
    command = [sys.executable, "-c", script, what, str(number), *_run(stand, recording)]
    _check(subprocess.run(command, capture_output=True, check=False), -signal.SIGKILL)
    before = {point.index for point in read_recording(recording).points}
    _check(subprocess.run([*TUMBLE, "resume", str(recording)], capture_output=True, check=False), 0)
    points = read_recording(recording).points
    kept = Counter(point.index for point in points)
    changed = sum(_readings(point) != _readings(whole[point.index]) for point in points)
    lost = sum(index not in kept for index in {*before, *range(len(whole))})
    return Killed(what=what, number=number, lost=lost, doubled=sum(kept.values()) - len(kept), changed=changed)


def report(
    about: str,
    stands: Mapping[bool, Callable[[Path], AbstractContextManager[Path]]],
    script: str,
    moments: Sequence[tuple[str, int]],
) -> None:
    """Kill at all moments, and say what became of the points; `stands` by whether they are emulated."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--emulated", action="store_true")
    stand_in = stands[parser.parse_args().emulated]
    with tempfile.TemporaryDirectory() as name, stand_in(Path(name)) as stand:
        folder = Path(name)
        whole = whole_run(stand, folder / "whole.mcap")
        results = []
        for what, number in moments:
            results.append(killed(script, stand, folder / f"{what}{number}.mcap", what, number, whole))
            print(results[-1], flush=True)
    lost, doubled = sum(each.lost for each in results), sum(each.doubled for each in results)
    print(f"{len(results)} kills: lost {lost}, doubled {doubled}, changed {sum(each.changed for each in results)}")


def _readings(point: Point) -> dict[str, float]:
    return {name: reading.mean for name, reading in point.readings.items()}


def _run(stand: Path, recording: Path) -> list[str]:
    programme = stand.with_name("programme.toml")
    where = ["--programme", str(programme), "--stand", str(stand)]
    return ["run", *where, "--serial", "kills", "--out", str(recording)]


def _check(done: "subprocess.CompletedProcess[bytes]", wanted: int) -> None:
    if done.returncode != wanted:
        raise RuntimeError(f"status {done.returncode} in place of {wanted}: {done.stderr.decode()[-500:]}")
