"""A simulated stand on an emulated CAN bus, and the drivers that reach it."""

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count

from tumble.drivers.candaq import CanDaq, DaqFrames
from tumble.drivers.cia402 import Cia402Head
from tumble.drivers.clock import Clock
from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.protocols import PositionerStatus
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.candaq import EmulatedCanDaq
from tumble.emulators.cia402 import EmulatedDrive
from tumble.emulators.cia402_drive import Drive
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld

FACTOR = 50.0
STEPS_PER_DEG = -1000.0
DEADLINE_S = 10.0
LOOK_S = 0.005
"""Between two looks at a head, which are messages to and fro."""

_numbers = count()


@dataclass(frozen=True, kw_only=True)
class CanBench:
    """A world, its clock, the channel of its bus, and a link to it."""

    world: SharedWorld
    clock: Clock
    channel: str
    link: CanLink
    node: EmulatedDrive

    @property
    def drive(self) -> Drive:
        """What is inside the emulated node."""
        return self.node._drive

    def head(self, **options) -> Cia402Head:
        chosen = {"limits_deg": (-180.0, 760.0), "steps_per_deg": STEPS_PER_DEG, "speed_deg_s": 20.0} | options
        return Cia402Head(self.link, 1, clock=self.clock, **chosen)

    def homed_head(self, **options) -> Cia402Head:
        head = self.head(**options)
        head.home()
        rested(head)
        return head

    def daq(self, frames: DaqFrames | None = None) -> CanDaq:
        return CanDaq(self.link, frames or DaqFrames.from_file(), self.clock)


@contextmanager
def can_bench(*faults: dict, frames: DaqFrames | None = None) -> Iterator[CanBench]:
    """A drive, a DAQ and a link in one process; every fault needs `device`, `kind` and `at`."""
    clock = FasterClock(FACTOR)
    stand = build(Simulated(noise_v=0.0), clock=clock)
    world = SharedWorld(stand)
    channel = f"bench-{next(_numbers)}"
    script = FaultScript.model_validate({"fault": faults})
    head_faults, daq_faults = (
        Faults(script, device, clock, lambda: stand.world.counts.dwells) for device in ("head", "daq")
    )
    drive = EmulatedDrive(world, channel, head_faults, steps_per_deg=STEPS_PER_DEG)
    daq = EmulatedCanDaq(world, channel, daq_faults, frames)
    link = CanLink(CanAddress(interface="virtual", channel=channel))
    try:
        yield CanBench(world=world, clock=clock, channel=channel, link=link, node=drive)
    finally:
        with ThreadPoolExecutor(3) as together:  # each waits for threads of its own
            list(together.map(lambda each: each.close(), (link, daq, drive)))


def rested(head: Cia402Head) -> PositionerStatus:
    """Status of the head once it does not move."""
    return until(head, lambda status: not status.moving)


def until(head, holds) -> PositionerStatus:
    deadline_s = time.monotonic() + DEADLINE_S
    while True:
        status = head.status()
        if holds(status):
            return status
        assert time.monotonic() < deadline_s, status
        time.sleep(LOOK_S)


def raised(kind: type[Exception], ask) -> Exception:
    """What `ask` raises, sooner or later."""
    deadline_s = time.monotonic() + DEADLINE_S
    while time.monotonic() < deadline_s:
        try:
            ask()
        except kind as error:
            return error
        time.sleep(LOOK_S)
    raise AssertionError(f"no {kind.__name__} came")
