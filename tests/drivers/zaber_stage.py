"""A Zaber head on an emulated stage in the same process and in virtual time: a real driver on a fake wire."""

from collections.abc import Callable

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import NoReplyError
from tumble.drivers.protocols import PositionerStatus
from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.drivers.zaber import ZaberHead
from tumble.emulators.faults import Fault, Faults, FaultScript
from tumble.emulators.world import SharedWorld
from tumble.emulators.zaber import EmulatedZaber

LIMITS_DEG = (-180.0, 760.0)


class FakeLink:
    """Hands lines to a device and back. `spoil` may change what it answers to a request."""

    def __init__(self, device: EmulatedZaber, faults: Faults) -> None:
        self.device = device
        self.faults = faults
        self.heard: list[str] = []
        self.reopened = 0
        self.spoil: Callable[[str, bytes], bytes] = lambda _, answer: answer
        self._waiting = b""

    def write(self, data: bytes) -> None:
        command = data.decode().partition(":")[0].split(" ", 3)[3:]
        self.heard += command or [""]
        self.faults.note_command(data)
        self._waiting += self.spoil(self.heard[-1], self.device.hear(data))

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        line, end, rest = self._waiting.partition(terminator)
        if not end:
            raise NoReplyError("link", "no line", "wait")
        self._waiting = rest
        return line + end

    def discard_input(self) -> None:
        self._waiting = b""

    def reopen(self) -> None:
        self.reopened += 1
        self._waiting = b""


class Stage:
    """Head, device, link and clock."""

    def __init__(
        self, *faults: dict[str, object], steps_per_deg: float = 1000.0, limits_deg: tuple[float, float] = LIMITS_DEG
    ) -> None:
        self.clock = VirtualClock(0)
        options = HeadOptions(limits_deg=LIMITS_DEG, steps_per_deg=steps_per_deg)
        self.shared = SharedWorld(build(Simulated(), clock=self.clock, head=options))
        script = FaultScript(fault=tuple(Fault.model_validate({"device": "head", **fault}) for fault in faults))
        faults = Faults(script, "head", self.clock)
        self.link = FakeLink(EmulatedZaber(self.shared, steps_per_deg=steps_per_deg, faults=faults), faults)
        self.head = ZaberHead(
            self.link, steps_per_deg=steps_per_deg, limits_deg=limits_deg, speed_deg_s=20.0, clock=self.clock
        )

    def homed(self) -> "Stage":
        self.head.identify()
        self.head.home()
        self.settle()
        self.link.heard.clear()
        return self

    def settle(self) -> PositionerStatus:
        """Wait until the head stands, at most ten minutes."""
        for _ in range(6000):
            if not (status := self.head.status()).moving:
                return status
            self.clock.sleep(0.1)
        raise AssertionError("it moves for ever")


def once(command: str, spoilt: Callable[[bytes], bytes]) -> Callable[[str, bytes], bytes]:
    """Spoil the answer to the first request that begins so."""
    left = [command]

    def spoil(request: str, answer: bytes) -> bytes:
        if left and request.startswith(left[0]):
            left.clear()
            return spoilt(answer)
        return answer

    return spoil
