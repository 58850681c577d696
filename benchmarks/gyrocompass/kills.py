"""Kill -9 in runs of a gyro platform: while it turns, settles, is averaged, or waits for a lean. POSIX only.

`python -m benchmarks.gyrocompass.kills [--kills 60]` kills runs of the stand in the process at moments spread evenly
over all waits of its clock, resumes them and compares: points lost, doubled, or with other readings than those of the
run that nobody killed. It prints one line in all.
"""

import argparse
import os
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Final

from benchmarks.endurance.processes import TUMBLE
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.steps import Point

PROGRAMME: Final = """method = "gyrocompass"
name = "kills"
dwell_s = 2.0

[[procedure]]
positions = "0/180/90/270"
base = 1

[[procedure]]
positions = "0/120"
base = 2
"""
_KILLING: Final = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.drivers.clock import ReleasedClock

last, waits = int(sys.argv.pop(1)), 0
sleep = ReleasedClock.sleep

def sleep_and_die(clock, duration_s):
    global waits
    waits += 1
    if waits == last:
        os.kill(os.getpid(), signal.SIGKILL)
    sleep(clock, duration_s)

ReleasedClock.sleep = sleep_and_die
try:
    main()
finally:
    print("waits", waits, file=sys.stderr)
"""


def run_killed(folder: Path, name: str, at_wait: int) -> tuple[int, int]:
    """Run and kill at a wait, 0 for never; returns the exit status, and how many waits there were."""
    command = ["run", "--programme", "kills.toml", "--serial", "G", "--out", name]
    ran = subprocess.run(
        [sys.executable, "-c", _KILLING, str(at_wait), *command],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    return ran.returncode, int(ran.stderr.split()[-1]) if ran.returncode == 0 else 0


def readings(point: Point) -> tuple[float, ...]:
    """What must be the same whoever was killed."""
    return tuple(reading.mean for reading in point.readings.values())


def main() -> None:
    """Kill, resume and compare."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=60)
    kills = parser.parse_args().kills
    before: Counter[int] = Counter()
    lost = doubled = changed = unusable = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "kills.toml").write_text(PROGRAMME, "utf-8")
        _, waits = run_killed(folder, "whole.mcap", 0)
        whole = read_recording(folder / "whole.mcap").points
        for number in range(kills):
            path = folder / f"{number}.mcap"
            status, _ = run_killed(folder, path.name, 1 + number * (waits - 1) // max(kills - 1, 1))
            assert status == -signal.SIGKILL, status
            if not path.exists():
                unusable += 1
                continue
            before[len(read_recording(path).points)] += 1
            subprocess.run([*TUMBLE, "resume", path.name], cwd=folder, capture_output=True, check=True, env=os.environ)
            points = read_recording(path).points
            kept = Counter(point.index for point in points)
            lost += sum(point.index not in kept for point in whole)
            doubled += sum(kept.values()) - len(kept)
            changed += sum(readings(point) != readings(whole[point.index]) for point in points)
    print(
        f"{kills} kills over {waits} waits, {unusable} before there was a file, points there before: "
        f"{dict(sorted(before.items()))}; lost {lost}, doubled {doubled}, with other readings {changed}"
    )


if __name__ == "__main__":
    main()
