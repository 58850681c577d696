"""The window under load: 50,000 samples/s on 4 channels, streamed by another process, recorded and plotted.

Every sample carries its own number, so that one that is lost is seen in the recording. Measured are the gaps between
beats of the event loop, the time that it spends on a frame (data into the plots, and painting them all, the samples
of every channel among them), and the memory of the process.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QSettings, Qt, QTimer

from tumble.app.running import Job, begin_recording
from tumble.app.stand import load_stand
from tumble.drivers.clock import SystemClock
from tumble.drivers.protocols import ChannelBlock, PositionerStatus
from tumble.procedures.announcer import Announcer
from tumble.procedures.events import (
    FinishReason,
    PointCompleted,
    RunFinished,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
)
from tumble.procedures.methods.dividing_head.layout import dwell_at
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.header import Header
from tumble.procedures.recording.reader import iter_samples
from tumble.procedures.steps import Dwell, Point
from tumble.window.look.plots import Plot
from tumble.window.start import Application, application

RATE_HZ, CHANNELS, BLOCK = 50_000, 4, 2_500
BEAT_MS = 2
_POINT_BLOCKS = 20
"""A point a second."""
_WARM_UP_S = 2.0
_PROGRAMME = 'name = "stream"\n[[procedure]]\nkind = "sweep"\nstep_deg = 0.5\npoints = 1400\n'


def source(minutes: float) -> None:
    """Write blocks to standard output when they are due, in doubles; what it was late by at most, to standard error."""
    blocks, began_s, late_s = round(minutes * 60 * RATE_HZ / BLOCK), time.monotonic(), 0.0
    for number in range(blocks):
        due_s = began_s + (number + 1) * BLOCK / RATE_HZ
        time.sleep(max(0.0, due_s - time.monotonic()))
        late_s = max(late_s, time.monotonic() - due_s)
        sys.stdout.buffer.write(block(number).tobytes())
        sys.stdout.buffer.flush()
    sys.stderr.write(f"{late_s:.3f}")


def block(number: int) -> NDArray[np.float64]:
    """A block of the stream, shape (channels, samples): every value is the number of its sample, in nanovolts."""
    first = number * BLOCK
    return (np.arange(first, first + BLOCK) * 1e-9)[None, :] + np.arange(CHANNELS)[:, None]


def blocks_from(stream: BinaryIO) -> Iterator[NDArray[np.float64]]:
    """The blocks as they come."""
    size = 8 * CHANNELS * BLOCK
    while len(data := stream.read(size)) == size:
        yield np.frombuffer(data).reshape(CHANNELS, BLOCK)


@dataclass(kw_only=True)
class Meter:
    """What is measured."""

    gaps_ms: "array[float]" = field(default_factory=lambda: array("f"))
    """In four bytes each, lest the scales weigh them: as numbers of Python they take 1 MB a minute."""
    frames_ms: "array[float]" = field(default_factory=lambda: array("f"))
    """By the clock, which goes on while other processes have the cores."""
    processor_ms: "array[float]" = field(default_factory=lambda: array("f"))
    """Of processor time that the thread of the window spends on a frame."""
    memory_mb: list[float] = field(default_factory=list)
    _beat_s: float = 0.0
    _frame_s: float = 0.0
    _frame_processor_s: float = 0.0

    def beat(self) -> None:
        """The event loop is alive."""
        now_s = time.perf_counter()
        if self._beat_s:
            self.gaps_ms.append(1e3 * (now_s - self._beat_s))
        self._beat_s = now_s

    def frame(self) -> None:
        """A frame begins: what was spent since the last one began is that one's."""
        if self._frame_s:
            self.frames_ms.append(1e3 * self._frame_s)
            self.processor_ms.append(1e3 * self._frame_processor_s)
        self._frame_s = self._frame_processor_s = 0.0

    def spend(self, seconds: float, processor_s: float) -> None:
        """Count time towards the frame, by the clock and of a processor."""
        self._frame_s += seconds
        self._frame_processor_s += processor_s

    def weigh(self) -> None:
        """Note the memory of the process."""
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        self.memory_mb.append(pages * os.sysconf("SC_PAGE_SIZE") / 2**20)

    def forget(self) -> None:
        """Begin anew: everything is warm."""
        del self.gaps_ms[:], self.frames_ms[:], self.processor_ms[:]


def timed(meter: Meter, function):
    """The same function, its time counted towards the frame."""

    def wrapper(*arguments):
        began_s, processor_s = time.perf_counter(), time.thread_time()
        try:
            return function(*arguments)
        finally:
            meter.spend(time.perf_counter() - began_s, time.thread_time() - processor_s)

    return wrapper


def record(running: Application, stream: BinaryIO, path: Path, job: Job) -> int:
    """Take blocks as the engine takes them: into the recording, then to the window; returns how many."""
    clock, bridge = SystemClock(), running.window.bridge
    announce = Announcer(begin_recording(path, header(job, clock), clock), [bridge.listen]).announce
    announce(StateChanged(state=State.RUNNING))
    began_s, count = clock.monotonic_s(), 0
    for count, voltage_v in enumerate(blocks_from(stream), 1):
        index = count // _POINT_BLOCKS
        now_s = clock.monotonic_s()
        if count % _POINT_BLOCKS == 1:
            announce(StepStarted(step=dwell(index)))
        announce(SamplesAcquired(point=index, time_s=now_s - began_s, block=as_block(voltage_v, now_s)))
        bridge.look("head", PositionerStatus(angle_deg=0.025 * count, moving=True, device_time_s=now_s))
        if count % _POINT_BLOCKS == 0:
            announce(PointCompleted(point=point(index - 1, voltage_v, now_s - began_s)))
    announce(RunFinished(reason=FinishReason.COMPLETED, message="the stream ended", at_standstill=True))
    return count


def as_block(voltage_v: NDArray[np.float64], now_s: float) -> ChannelBlock:
    channels = {f"channel_{number}_v": row_v for number, row_v in enumerate(voltage_v)}
    return ChannelBlock(channels=channels, rate_hz=RATE_HZ, device_time_s=now_s, temperature_degc=23.0)


def dwell(index: int) -> Dwell:
    return dwell_at(angle_deg=0.5 * index, procedure="sweep", realisation=1, mount="face-up")


def point(index: int, voltage_v: NDArray[np.float64], time_s: float) -> Point:
    rng = np.random.default_rng(index)
    output_v = 2.5 - np.sin(np.deg2rad(0.5 * index)) + 1e-4 * rng.standard_normal()
    return Row(
        index=index, angle_deg=0.5 * index, voltage_v=float(output_v), voltage_sd_v=1e-3, samples=voltage_v.shape[1],
        time_s=time_s, direction=1, temperature_degc=23.0 + 0.01 * rng.standard_normal(), realisation=1,
        procedure="sweep", mount="face-up", settled=True,
    ).point  # fmt: skip


def header(job: Job, clock: SystemClock) -> Header:
    return Header(
        serial_number="STREAM", operator="", programme_text=job.programme.text, programme_sha256=job.programme.sha256,
        stand=job.stand.recorded, stand_path="", stand_sha256=job.stand.sha256, program_version="", git_commit="",
        git_dirty=False, packages={}, started_wall_ns=clock.wall_ns(), started_monotonic_s=clock.monotonic_s(),
        job="run",
    )  # fmt: skip


def lost(path: Path, blocks: int) -> int:
    """Samples that are not in the recording where they belong."""
    bad = number = 0
    for number, taken in enumerate(iter_samples(path), 1):
        bad += int(np.count_nonzero(np.stack([*taken.block.channels.values()]) != block(number - 1)))
    return bad + (blocks - number) * BLOCK * CHANNELS


def measure(minutes: float) -> dict[str, Any]:
    """Stream for so long, and say what came of it."""
    folder = Path(tempfile.mkdtemp())
    QSettings.setDefaultFormat(QSettings.Format.IniFormat)
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(folder))
    qt, meter = application(), Meter()
    running = Application(qt, folder / "store")
    view = running.window.run.view
    view._draw = timed(meter, view._draw)
    Plot.paintEvent = timed(meter, Plot.paintEvent)
    view._redraw.timeout.disconnect()
    view._redraw.timeout.connect(meter.frame)
    view._redraw.timeout.connect(view._draw)
    job = Job(stand=load_stand(), programme=programme_from_text(_PROGRAMME, "stream"), serial_number="STREAM")
    running.window.open(running.window.run)
    view.begin(job, job.plan())
    view.tabs.setCurrentWidget(view.samples)
    running.window.run.course.now.running = True
    beat = QTimer(interval=BEAT_MS, timerType=Qt.TimerType.PreciseTimer)
    beat.timeout.connect(meter.beat)
    beat.start()
    scales = QTimer(interval=1_000)
    scales.timeout.connect(meter.weigh)
    scales.start()
    QTimer.singleShot(round(1e3 * _WARM_UP_S), meter.forget)
    command = [sys.executable, "-m", "benchmarks.window_streaming", "--source", "--minutes", str(minutes)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as streaming:
        taken: list[int] = []
        recorded = folder / "stream.mcap"

        def work() -> None:
            try:
                taken.append(record(running, streaming.stdout, recorded, job))
            finally:
                running.window.worker.stage.emit("over")

        running.window.worker.stage.connect(lambda _: qt.exit())
        thread = Thread(target=work)
        thread.start()
        qt.exec()
        thread.join()
        late_s = float(streaming.stderr.read())
    beat.stop()
    drawn = view.overview.done
    running.window.run.course.now.running = False
    running.window.leave()
    return summary(meter) | {
        "blocks": taken[0],
        "points_drawn": drawn,
        "source_late_s": late_s,
        "lost_samples": lost(recorded, round(minutes * 60 * RATE_HZ / BLOCK)),
    }


def summary(meter: Meter) -> dict[str, Any]:
    gaps, frames, memory = np.array(meter.gaps_ms), np.array(meter.frames_ms), meter.memory_mb
    processor = np.array(meter.processor_ms)
    return {
        "gap_p50_ms": float(np.percentile(gaps, 50)),
        "gap_p99_ms": float(np.percentile(gaps, 99)),
        "gap_p99_9_ms": float(np.percentile(gaps, 99.9)),
        "gap_max_ms": float(gaps.max()),
        "frames": len(frames),
        "frame_median_ms": float(np.median(frames)),
        "frame_p99_ms": float(np.percentile(frames, 99)),
        "frame_processor_median_ms": float(np.median(processor)),
        "frame_processor_p99_ms": float(np.percentile(processor, 99)),
        "memory_mb": [round(memory[place], 1) for place in np.linspace(0, len(memory) - 1, 7).round().astype(int)],
    }


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--minutes", type=float, default=10.0)
    arguments.add_argument("--source", action="store_true", help=argparse.SUPPRESS)
    chosen = arguments.parse_args()
    if chosen.source:
        source(chosen.minutes)
    else:
        print(json.dumps(measure(chosen.minutes), indent=2))


if __name__ == "__main__":
    main()
