"""Runs of `tumble` that are killed with SIGKILL, and go on. POSIX only."""

import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from benchmarks.endurance.processes import SIMULATED, TUMBLE

AT_BOUNDARY = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.writer import Recorder

last, record = int(sys.argv.pop(1)), Recorder.record

def record_and_die(recorder, event):
    record(recorder, event)
    if isinstance(event, PointCompleted) and event.point.index == last:
        os.kill(os.getpid(), signal.SIGKILL)

Recorder.record = record_and_die
main()
"""
AFTER_OUTAGE = """\
import sys
from tumble.app.cli import main
from tumble.drivers.simulated.world import SimulatedWorld

outage_s, put_back = float(sys.argv.pop(1)), SimulatedWorld.put_back

def put_back_and_live_on(world, counts, later_s):
    put_back(world, counts, later_s - outage_s)

SimulatedWorld.put_back = put_back_and_live_on
main()
"""


@dataclass(frozen=True, kw_only=True)
class Job:
    """What is run on the simulated stand, and for how long that lives on after a kill before the run goes on."""

    programme: str
    simulated: str = "seed = 1"
    """Table of the stand file."""
    outage_s: float = 0.0

    def begin(self, recording: Path) -> list[str]:
        """Arguments of `tumble`; every recording has a stand of its own, since two runs cannot share one."""
        stand = SIMULATED.write_stand(recording.with_suffix(".toml"), self.simulated)
        run = ["run", "--programme", self.programme, "--stand", str(stand)]
        return [*run, "--serial", "kills", "--out", str(recording)]

    def resume(self, recording: Path) -> subprocess.CompletedProcess[str]:
        """Have the run go on."""
        command = [sys.executable, "-c", AFTER_OUTAGE, f"{self.outage_s}", "resume", str(recording)]
        return subprocess.run(command, capture_output=True, text=True, check=False)


def undisturbed(job: Job, recording: Path) -> float:
    """Run to the end; returns how long it took once the recording was there, in s."""
    with subprocess.Popen([*TUMBLE, *job.begin(recording)], stderr=subprocess.DEVNULL) as process:
        _await(process, recording)
        began_s = time.monotonic()
        _check(process.wait(), 0)
    return time.monotonic() - began_s


def kill_at(point: int, job: Job, recording: Path) -> None:
    """Run until a point is completed and die there."""
    command = [sys.executable, "-c", AT_BOUNDARY, str(point), *job.begin(recording)]
    _check(subprocess.run(command, stderr=subprocess.DEVNULL, check=False).returncode, -signal.SIGKILL)


def killed_after(moment_s: float, job: Job, recording: Path) -> bool:
    """Run until a moment after the recording has appeared, and kill; false where the run was done before."""
    with subprocess.Popen([*TUMBLE, *job.begin(recording)], stderr=subprocess.DEVNULL) as process:
        _await(process, recording)
        time.sleep(moment_s)
        process.kill()
        status = process.wait()
    _check(status, 0, -signal.SIGKILL)
    return status != 0


def _check(status: int, *allowed: int) -> None:
    if status not in allowed:
        raise RuntimeError(f"a run ended with status {status}")


def _await(process: subprocess.Popen[bytes], recording: Path) -> None:
    while process.poll() is None and not recording.exists():
        time.sleep(0.001)
