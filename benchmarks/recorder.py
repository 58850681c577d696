"""How fast the recorder takes samples, how much memory it needs, how long a completed point takes.

Run it with `python benchmarks/recorder.py`; it writes about 350 MB into a temporary folder. A sample is one instant on
four channels. Every 10,000 samples a point is completed and synchronised with the disk, and that is in the time.
"""

import resource
import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from unittest.mock import patch

import numpy as np

from tumble.drivers.clock import SystemClock
from tumble.drivers.protocols import ChannelBlock
from tumble.procedures.events import FinishReason, PointCompleted, RunFinished, SamplesAcquired
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.procedures.recording.header import Header
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.writer import Recorder

CHANNELS, SAMPLES_PER_BLOCK = 4, 10_000
CLOCK = SystemClock()


def header() -> Header:
    return Header(
        serial_number="benchmark",
        operator="",
        programme_text="",
        programme_sha256="",
        stand={},
        stand_path="",
        stand_sha256="",
        program_version="0",
        git_commit="",
        git_dirty=False,
        packages={},
        started_wall_ns=CLOCK.wall_ns(),
        started_monotonic_s=CLOCK.monotonic_s(),
    )


def blocks(count: int) -> Iterator[SamplesAcquired]:
    for index in range(count):
        noise_v = np.random.default_rng(index).normal(2.5, 1e-3, (CHANNELS, SAMPLES_PER_BLOCK))
        channels = {f"channel_{number}_v": row_v for number, row_v in enumerate(noise_v)}
        block = ChannelBlock(channels=channels, rate_hz=1e5, device_time_s=0.1 * index, temperature_degc=23.0)
        yield SamplesAcquired(point=index, time_s=0.1 * index, block=block)


def completed(index: int) -> PointCompleted:
    row = Row(
        index=index,
        angle_deg=5.0 * index,
        voltage_v=2.5,
        voltage_sd_v=1e-3,
        samples=SAMPLES_PER_BLOCK,
        time_s=0.1 * index,
        direction=1,
        temperature_degc=23.0,
        realisation=1,
        procedure="sweep",
        mount="face-up",
        settled=True,
    )
    return PointCompleted(point=row.point)


def seconds_to_record(path: Path, samples: int) -> float:
    spent_s = 0.0
    with Recorder(path, header(), CLOCK) as recorder:
        for block in blocks(samples // SAMPLES_PER_BLOCK):
            begun_s = time.perf_counter()
            recorder.record(block)
            recorder.record(completed(block.point))
            spent_s += time.perf_counter() - begun_s
        recorder.record(RunFinished(reason=FinishReason.COMPLETED, message="", at_standstill=True))
    return spent_s


def check_nothing_dropped(path: Path, samples: int) -> None:
    count = samples // SAMPLES_PER_BLOCK
    for written, read in zip_longest(blocks(count), iter_samples(path)):
        if not np.array_equal(written.block.voltage_v, read.block.voltage_v):
            sys.exit(f"block {written.point} came back changed")
    recording = read_recording(path)
    if not recording.complete or [point.index for point in recording.points] != list(range(count)):
        sys.exit("points are missing")


def peak_memory_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def milliseconds_per_point(path: Path, points: int = 500) -> float:
    with Recorder(path, header(), CLOCK) as recorder:
        begun_s = time.perf_counter()
        for index in range(points):
            recorder.record(completed(index))
        return (time.perf_counter() - begun_s) / points * 1e3


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        print(f"completed point, synchronised:     {milliseconds_per_point(Path(folder, 'a.mcap')):.3f} ms")
        with patch("os.fsync"):
            print(f"completed point, only written:     {milliseconds_per_point(Path(folder, 'b.mcap')):.3f} ms")
        seconds_to_record(Path(folder, "small.mcap"), 1_000_000)
        peak_mb = peak_memory_mb()
        path = Path(folder, "large.mcap")
        spent_s = seconds_to_record(path, 10_000_000)
        print(f"samples on {CHANNELS} channels:             {10_000_000 / spent_s:,.0f} per s")
        print(f"growth of the peak memory, 1M-10M: {peak_memory_mb() - peak_mb:.1f} MB (peak {peak_mb:.0f} MB)")
        print(f"file:                              {path.stat().st_size / 1e6:.0f} MB")
        begun_s = time.perf_counter()
        check_nothing_dropped(path, 10_000_000)
        print(f"read back, nothing dropped:        {time.perf_counter() - begun_s:.1f} s")
        print(f"peak memory with reading:          {peak_memory_mb():.0f} MB")


if __name__ == "__main__":
    main()
