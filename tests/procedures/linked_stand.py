"""A fake stand whose instruments are behind cables that can be pulled."""

from dataclasses import replace

from fakes import FakeDaq, FakeHead

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import LinkLostError, NoReplyError
from tumble.drivers.protocols import Identity, PositionerStatus


class Link:
    """A cable that is pulled, and comes back after some seconds."""

    def __init__(self, clock: VirtualClock, device: str) -> None:
        self.clock, self.device = clock, device
        self.back_s = 0.0
        self.open = True
        self.reopened = 0
        self.serial = "17"
        self.silent = 0

    def pull(self, for_s: float) -> None:
        self.open, self.back_s = False, self.clock.monotonic_s() + for_s

    def check(self) -> None:
        if not self.open:
            raise LinkLostError(self.device, "the port is gone", "check the cable")

    def reopen(self) -> None:
        if self.clock.monotonic_s() < self.back_s:
            raise LinkLostError(self.device, "the port is gone", "check the cable")
        self.open = True
        self.reopened += 1

    def identity(self) -> Identity:
        self.check()
        if self.silent:
            self.silent -= 1
            raise NoReplyError(self.device, "gave no answer", "check that it is on")
        return Identity(model="fake", serial=self.serial, firmware="1.0")


class LinkedHead(FakeHead):
    """A head behind a cable; homed on command, and to be homed after a loss of power."""

    def __init__(self, clock):
        super().__init__(clock)
        self.link = Link(clock, "fake head")
        self.referenced = True
        self.homings = 0

    def reconnect(self):
        self.link.reopen()

    def identify(self):
        return self.link.identity()

    def home(self):
        self.link.check()
        self.homings += 1
        self.referenced = True
        super().start_move(0.0)

    def start_move(self, angle_deg):
        self.link.check()
        super().start_move(angle_deg)

    def status(self) -> PositionerStatus:
        self.on_status()
        self.link.check()
        return replace(super().status(), referenced=self.referenced)

    def stop(self):
        self.link.check()
        super().stop()


class LinkedDaq(FakeDaq):
    """A DAQ behind a cable."""

    def __init__(self, clock, head):
        super().__init__(clock, head)
        self.link = Link(clock, "fake DAQ")

    def reconnect(self):
        self.link.reopen()

    def identify(self):
        return self.link.identity()

    def acquire(self, samples, rate_hz):
        block = super().acquire(samples, rate_hz)
        self.link.check()
        return block
