"""A multimeter on a wire without a wire: what a driver writes is heard by the emulator at once, in virtual time."""

from collections.abc import Callable, Mapping

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import LinkLostError, NoReplyError
from tumble.drivers.simulated import Simulated, build
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.scpi import Multimeter, ScpiSession
from tumble.emulators.scpi.models import Messages
from tumble.emulators.world import SharedWorld

Spoil = Callable[[bytes], bytes]
PATIENCE = 1_000


class EmulatedLink:
    """Fits `tumble.drivers.scpi.meter.ReopenableLink`; answers and commands are spoilt by their number."""

    checksummed = True

    def __init__(self, session: ScpiSession, faults: Faults, clock: VirtualClock) -> None:
        self.session = session
        self.faults = faults
        self.clock = clock
        self.spoil_answer: Mapping[int, Spoil] = {}
        self.spoil_command: Mapping[int, Spoil] = {}
        self.written: list[str] = []
        self.answers = 0
        self.reopened = 0
        self.gone = False
        self._heard = b""
        self._waiting = b""

    def write(self, data: bytes) -> None:
        if self.gone:
            raise LinkLostError("link", "is gone", "wait")
        spoil = self.spoil_command.get(len(self.written), bytes)
        self.written.append(data.decode().strip())
        self._heard += spoil(data)
        *lines, self._heard = self._heard.split(b"\n")
        for line in lines:
            self.faults.note_command(line)
            self._answer(self.session.received(line + b"\n"))

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        for _ in range(PATIENCE):
            if terminator in self._waiting:
                line, self._waiting = self._waiting.split(terminator, 1)
                return line + terminator
            self.clock.sleep(timeout_s / PATIENCE)
            self._answer(self.session.due())
        raise NoReplyError("link", "gave no answer", "check it")

    def discard_input(self) -> None:
        self._waiting = b""

    def reopen(self) -> None:
        self.reopened += 1
        self.gone = False

    def _answer(self, line: bytes) -> None:
        if line:
            self._waiting += self.spoil_answer.get(self.answers, bytes)(line)
            self.answers += 1


def emulated(
    settings: Simulated | None = None,
    faults: FaultScript | None = None,
    model: str = "34461A",
    messages: Messages | None = None,
    checksummed: bool = True,
) -> tuple[EmulatedLink, VirtualClock]:
    clock = VirtualClock()
    world = SharedWorld(build(settings or Simulated(), clock=clock))
    due = Faults(faults, "daq", clock, lambda: world.world.counts.dwells)
    link = EmulatedLink(ScpiSession(Multimeter(world, due, model=model, messages=messages)), due, clock)
    link.checksummed = checksummed
    return link, clock
