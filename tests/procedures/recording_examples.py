"""Small recordings for the tests of the recording."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from tumble.drivers.clock import VirtualClock
from tumble.drivers.protocols import SampleBlock
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    Event,
    FinishReason,
    PointCompleted,
    RunFinished,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.methods.dividing_head.layout import MOUNT, dwell_at, mounting
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.procedures.recording.header import Header
from tumble.procedures.recording.writer import Recorder

STARTED_NS = 1_800_000_000_000_000_000

HEADER = Header(
    serial_number="SN 17",
    operator="Олена",
    programme_text='name = "sweep"\n# 5° steps\n',
    programme_sha256="ab" * 32,
    stand={"name": "bench-1", "head": {"limits_deg": [-180.0, 760.0]}, "site": {"gravity_m_s2": 9.8107}},
    stand_path="stands/bench-1.toml",
    stand_sha256="cd" * 32,
    program_version="0.1.0",
    git_commit="",
    git_dirty=True,
    packages={"numpy": "2.2.0", "mcap": "1.6.0"},
    started_wall_ns=STARTED_NS,
    started_monotonic_s=0.0,
)

ROW = Row(
    index=0,
    angle_deg=395.0,
    voltage_v=2.5001234567890123,
    voltage_sd_v=1.1e-3,
    samples=3,
    time_s=12.5,
    direction=-1,
    temperature_degc=23.25,
    realisation=1,
    procedure="sweep",
    mount="face-up",
    settled=True,
)
POINT = ROW.point

FINISHED = RunFinished(reason=FinishReason.COMPLETED, message="all points are in", at_standstill=True)


def samples(point: int, voltage_v: Iterable[float] = (2.5, 2.50001, 9.9e37)) -> SamplesAcquired:
    block = SampleBlock(voltage_v=np.array(list(voltage_v)), rate_hz=100.0, device_time_s=0.75, temperature_degc=23.25)
    return SamplesAcquired(point=point, time_s=12.0 + point, block=block)


def completed(index: int, **changes: object) -> PointCompleted:
    return PointCompleted(point=replace(ROW, index=index, **changes).point)


def run_of(points: int) -> list[Event]:
    """Events of a short run with every kind in it."""
    dwell = dwell_at(angle_deg=35.0, procedure="sweep", realisation=1, mount="face-up")
    dwells = [(StepStarted(step=dwell), samples(index), completed(index)) for index in range(points)]
    return [
        StateChanged(state=State.RUNNING),
        StepStarted(step=mounting("face-up")),
        ConditionRequested(condition=MOUNT, value="face-up", prompt="Seat the unit face-up"),
        ConditionAnswered(condition=MOUNT, value="face-up", answer="так, сидить", confirmed=True),
        WarningRaised(message="the certificate of the DAQ has expired"),
        *(event for dwelling in dwells for event in dwelling),
        FINISHED,
    ]


def record(path: Path, events: Iterable[Event], header: Header = HEADER) -> Path:
    clock = VirtualClock(wall_start_ns=STARTED_NS)
    with Recorder(path, header, clock) as recorder:
        for event in events:
            clock.sleep(0.125)
            recorder.record(event)
    return path
