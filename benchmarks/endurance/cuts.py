"""A recording cut at random byte lengths: is every point read that was complete before the cut?

`python -m benchmarks.endurance.cuts [--count 1000]` records a `quick` run, notes the size of the file on the disk after
every point, and cuts copies of it. A cut file must give every point that was on the disk at that size, each as it was
with its samples, and at most the one besides that was being written: behind a point comes an index, which reading does
without.
"""

import argparse
import random
import subprocess
import sys
import tempfile
from bisect import bisect_right
from dataclasses import dataclass
from pathlib import Path

from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.steps import Point

NOTING = """\
import os, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.writer import Recorder

record, begin = Recorder.record, Recorder.__init__

def note(recorder):
    print(os.path.getsize(recorder.path), flush=True)

def begin_and_note(recorder, *arguments, **named):
    begin(recorder, *arguments, **named)
    note(recorder)

def record_and_note(recorder, event):
    record(recorder, event)
    if isinstance(event, PointCompleted):
        note(recorder)

Recorder.__init__, Recorder.record = begin_and_note, record_and_note
main()
"""


@dataclass(frozen=True, kw_only=True)
class Recorded:
    """A recording, and its size when the header, and then each point, was on the disk."""

    path: Path
    sizes: list[int]
    points: tuple[Point, ...]


def recorded(folder: Path, programme: str = "quick") -> Recorded:
    """Run a programme and note the sizes."""
    path = folder / "whole.mcap"
    command = [sys.executable, "-c", NOTING, "run", "--programme", programme, "--serial", "cuts", "--out", str(path)]
    ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    return Recorded(path=path, sizes=[int(line) for line in ran.stdout.split()], points=read_recording(path).points)


def cut_correctly(whole: Recorded, content: bytes, size: int, copy: Path) -> bool:
    """Whether a copy of so many bytes gives the points that were complete at that size."""
    copy.write_bytes(content[:size])
    complete = bisect_right(whole.sizes, size) - 1
    try:
        found = read_recording(copy).points
        sampled = {block.point for block in iter_samples(copy)}
    except RecordingError:
        return complete < 0
    as_it_was = found == whole.points[: len(found)] and sampled.issuperset(range(len(found)))
    return as_it_was and 0 <= len(found) - max(complete, 0) <= 1


def wrong_cuts(whole: Recorded, folder: Path, count: int, seed: int) -> list[int]:
    """Sizes at which something else than the complete points was read."""
    content = whole.path.read_bytes()
    sizes = [random.Random(seed + number).randrange(len(content)) for number in range(count)]
    boundaries = [size + off for size in whole.sizes for off in (-1, 0, 1)]
    copy = folder / "cut.mcap"
    return [size for size in (*boundaries, *sizes) if not cut_correctly(whole, content, size, copy)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wrong = wrong_cuts(recorded(folder), folder, options.count, options.seed)
    print(f"{options.count} cuts at random, and those at and next to every point boundary: {len(wrong)} read wrongly")
    if wrong:
        sys.exit(f"at {wrong[:20]} bytes")


if __name__ == "__main__":
    main()
