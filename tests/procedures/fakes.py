"""A head, a DAQ, an operator and a sink in virtual time, whose output depends on the pose alone."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.drivers.attention import Attention
from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Identity, PositionerStatus, SampleBlock, Stand
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.engine import Engine
from tumble.procedures.events import Event
from tumble.procedures.methods.dividing_head.layout import HEAD, MOUNT
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.procedures.operator import Answer
from tumble.procedures.steps import Ask, Dwell, Point

QUICK = Acquisition(samples=10, rate_hz=100.0, settle_samples=2, settle_timeout_s=1.0)
"""Settings of a run that tests something else."""


class FakeHead:
    """Turns at an even speed and stops at once."""

    limits_deg = (-360.0, 760.0)
    speed_deg_s = 30.0

    def __init__(self, clock: VirtualClock) -> None:
        self._clock = clock
        self._from_deg = self._to_deg = 0.0
        self._since_s = 0.0
        self.targets_deg: list[float] = []
        self.stops = 0
        self.deaf_stops = 0
        """How many commands to stop get lost."""
        self.stuck_at_deg: float | None = None
        self.knows = True
        """Whether it knows its angle; homing tells it."""
        self.coasting = False
        """Says for ever that it moves."""
        self.on_status: Callable[[], None] = lambda: None

    def identify(self) -> Identity:
        return Identity(model="fake head", serial="1")

    def home(self) -> None:
        self.knows = True
        self.start_move(0.0)

    def start_move(self, angle_deg: float) -> None:
        self.targets_deg.append(angle_deg)
        self._from_deg, self._since_s = self._angle_deg(), self._clock.monotonic_s()
        self._to_deg = angle_deg if self.stuck_at_deg is None else self.stuck_at_deg

    def status(self) -> PositionerStatus:
        self.on_status()
        angle_deg = self._angle_deg()
        return PositionerStatus(
            angle_deg=angle_deg,
            moving=self.coasting or angle_deg != self._to_deg,
            device_time_s=self._clock.monotonic_s(),
            referenced=self.knows,
        )

    def stop(self) -> None:
        self.stops += 1
        if self.deaf_stops:
            self.deaf_stops -= 1
            raise DeviceError("fake head", "did not take the command", "try again")
        self._from_deg = self._to_deg = self._angle_deg()

    def _angle_deg(self) -> float:
        way_deg = self._to_deg - self._from_deg
        turned_deg = self.speed_deg_s * (self._clock.monotonic_s() - self._since_s)
        return self._to_deg if turned_deg >= abs(way_deg) else self._from_deg + np.sign(way_deg) * turned_deg


@lru_cache(maxsize=4096)
def ax_at(mount: str, angle_deg: float) -> float:
    """What an ideal unit feels along its x axis, in g."""
    return float(projections([mount], np.array([angle_deg]))[0, 0])


class FakeDaq:
    """Gives 2.5 V and 1 V/g along x, and 1 mV of fixed ripple."""

    def __init__(self, clock: VirtualClock, head: FakeHead) -> None:
        self._clock = clock
        self._head = head
        self.mount = "end"
        self.overload_at: set[int] = set()
        """Blocks, from 0, in which the first sample overloads."""
        self.creep_v = 0.0
        """By how much the output rises from block to block."""
        self.short_by = 0
        self.blocks = 0
        self.on_acquire: Callable[[], None] = lambda: None

    def identify(self) -> Identity:
        return Identity(model="fake DAQ", serial="2")

    def acquire(self, samples: int, rate_hz: float) -> SampleBlock:
        self.on_acquire()
        began_s = self._clock.monotonic_s()
        ax_g = ax_at(self.mount, self._head.status().angle_deg)
        voltage_v = 2.5 + ax_g + self.creep_v * self.blocks + 1e-3 * (-1.0) ** np.arange(samples - self.short_by)
        if self.blocks in self.overload_at:
            voltage_v[0] = 9.9e37
        self.blocks += 1
        self._clock.sleep(samples / rate_hz)
        return SampleBlock(voltage_v=voltage_v, rate_hz=rate_hz, device_time_s=began_s, temperature_degc=23.0)


@dataclass
class FakeOperator:
    """Seats the unit as asked and says so after some looks; `answer` may say something else."""

    daq: FakeDaq
    looks: int = 0
    answer: Answer | None = None
    asked: list[str] = field(default_factory=list)
    on_poll: Callable[[], None] = lambda: None
    _left: int = 0

    def ask(self, ask: Ask) -> None:
        self.asked.append(ask.value)
        self._left = self.looks

    def poll(self) -> Answer | None:
        self.on_poll()
        if self._left:
            self._left -= 1
            return None
        if self.answer is None:
            self.daq.mount = self.asked[-1]
            return Answer(text="yes", confirmed=True)
        return self.answer


@dataclass
class MemorySink:
    """Keeps events, until it fails."""

    fails_at: Callable[[Event], bool] = lambda event: False
    events: list[Event] = field(default_factory=list)

    def record(self, event: Event) -> None:
        if self.fails_at(event):
            raise OSError("No space left on device")
        self.events.append(event)

    def of(self, kind: type) -> list:
        return [event for event in self.events if isinstance(event, kind)]


class FakeStand:
    """Everything that an engine needs, and the engine."""

    def __init__(self) -> None:
        self.clock = VirtualClock(wall_start_ns=0)
        self.attention = Attention()
        self.head = FakeHead(self.clock)
        self.daq = FakeDaq(self.clock, self.head)
        self.operator = FakeOperator(self.daq)
        self.sink = MemorySink()

    def engine(self, acquisition: Acquisition = QUICK, listeners=(), serials=None) -> Engine:
        stand = Stand(
            name="fake",
            positioners={"head": self.head},
            samplers={"daq": self.daq},
            clock=self.clock,
            serials=serials or {},
            titles={"head": "dividing head", "daq": "DAQ"},
            attention=self.attention,
        )
        return Engine(stand, self.operator, self.sink, acquisition, listeners)


def point_at(dwell: Dwell, voltage_v: float = 0.0, index: int = 0) -> Point:
    """The point of a dwell that went as planned."""
    row = Row(
        index=index,
        angle_deg=dwell.targets_deg[HEAD],
        voltage_v=voltage_v,
        voltage_sd_v=1e-3,
        samples=10,
        time_s=float(index),
        direction=1,
        temperature_degc=None,
        realisation=dwell.realisation,
        procedure=dwell.procedure,
        mount=dwell.conditions[MOUNT],
        settled=True,
    )
    return row.point
