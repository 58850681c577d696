"""How long `tumble report` takes for a stored record, process included: `python -m benchmarks.report_again`.

It calibrates a simulated unit (`seed`, 430 points) into a folder that is thrown away, then writes the report of its
record five times as page and as paper, and prints best and median by the clock and of processor time.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

ROUNDS = 5


def main() -> None:
    """Measure and print."""
    with TemporaryDirectory() as folder:
        store, said = Path(folder) / "store", Path(folder) / "fit.json"
        _tumble("calibrate", "--programme", "seed", "--serial", "SN1", "--store", store, "--json", said)
        record = json.loads(said.read_text("utf-8"))["record"]
        for suffix in (".html", ".pdf"):
            out = Path(folder) / f"report{suffix}"
            rounds = [_timed("report", record, "--store", store, "--out", out) for _ in range(ROUNDS)]
            clock, processor = zip(*rounds, strict=True)
            print(
                f"{suffix}: {min(clock):.2f} s by the clock (median {median(clock):.2f}), "
                f"{min(processor):.2f} s of processor time (median {median(processor):.2f}), "
                f"{out.stat().st_size / 1e3:.0f} kB"
            )


def _timed(*arguments: object) -> tuple[float, float]:
    """Seconds by the clock, and of processor time, that a command takes."""
    began, before = perf_counter(), os.times()
    _tumble(*arguments)
    after = os.times()
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return perf_counter() - began, spent


def _tumble(*arguments: object) -> None:
    subprocess.run([sys.executable, "-m", "tumble", *map(str, arguments)], check=True, capture_output=True)


if __name__ == "__main__":
    main()
