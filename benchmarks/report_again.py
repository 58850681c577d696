"""How long `tumble report` takes for a stored record, process included: `python -m benchmarks.report_again`.

It calibrates a simulated unit twice (`seed`, 430 points) into a folder that is thrown away, then writes the report of
the second record, which tells what has changed since the first, five times as page and as paper in every language. It
prints best and median by the clock and of processor time, the size, and the pages of what is paper.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from tumble.messages import Language

ROUNDS = 5


def main() -> None:
    """Measure and print."""
    with TemporaryDirectory() as folder:
        store, said = Path(folder) / "store", Path(folder) / "fit.json"
        for _ in range(2):
            _tumble("calibrate", "--programme", "seed", "--serial", "SN1", "--store", store, "--json", said)
        record = json.loads(said.read_text("utf-8"))["record"]
        for language in Language:
            for suffix in (".html", ".pdf"):
                _write(store, record, language, Path(folder) / f"report{suffix}")


def _write(store: Path, record: str, language: Language, out: Path) -> None:
    """Write the report of a record a few times, and say how long it took and what came of it."""
    asked = ("--language", language, "report", record, "--store", store, "--out", out)
    clock, processor = zip(*[_timed(*asked) for _ in range(ROUNDS)], strict=True)
    pages = re.search(rb"<xmpTPg:NPages>(\d+)<", out.read_bytes())
    print(
        f"{language} {out.suffix}: {min(clock):.2f} s by the clock (median {median(clock):.2f}), "
        f"{min(processor):.2f} s of processor time (median {median(processor):.2f}), "
        f"{out.stat().st_size / 1e3:.0f} kB{f', {int(pages[1])} pages' if pages else ''}"
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
