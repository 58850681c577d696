"""The stand of the window, as one object."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from typing import Final

from tumble.app.simulation import Past
from tumble.app.stand import LoadedStand
from tumble.app.stand_lock import holding
from tumble.app.wiring import Attendant, Connected, connect
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Identity, PositionerStatus
from tumble.drivers.tables import DAQ, HEAD
from tumble.messages import Message
from tumble.procedures.motion import Motion

_TOLERANCE_DEG: Final = 0.01


@dataclass(frozen=True, kw_only=True)
class StandIdentity:
    """A stand that answers."""

    loaded: LoadedStand
    head: Identity
    daq: Identity
    status: PositionerStatus
    warnings: tuple[str, ...]


class StandSession:
    """A stand from the moment it is chosen: its file, and its instruments while they are connected.

    There is one at a time, `StandWorker.session`: what is on screen, what a key moves and what a run measures on are
    read from it, and another stand takes its place as a whole. Everything but `loaded` belongs to the stand's thread.
    """

    def __init__(self, loaded: LoadedStand, look: Callable[[PositionerStatus], None]) -> None:
        self.loaded = loaded
        self._look = look
        self._connected: Connected | None = None
        self._held = ExitStack()

    def is_of(self, other: LoadedStand) -> bool:
        """Whether a stand file is the one that was chosen: it lies in the same place and says the same."""
        return (_place(other), other.sha256) == (_place(self.loaded), self.loaded.sha256)

    @property
    def is_connected(self) -> bool:
        """Whether there are instruments."""
        return self._connected is not None

    @property
    def connected(self) -> Connected:
        """The instruments. Raises `DeviceError` where there are none."""
        if self._connected is None:
            raise DeviceError(Message("stand"), Message("is not connected"), Message("connect it first"))
        return self._connected

    @property
    def angle_deg(self) -> float:
        """Where the head is, as it reads it now. Raises `DeviceError`."""
        return self.connected.stand.positioners[HEAD].status().angle_deg

    @property
    def motion(self) -> Motion:
        """Moves of the head. Raises `DeviceError`."""
        stand = self.connected.stand
        return Motion(stand.positioners[HEAD], stand.clock, _TOLERANCE_DEG, look=self._look, title=stand.title(HEAD))

    def connect(self, attendant: Attendant, past: Sequence[Past] = ()) -> StandIdentity:
        """Reach the instruments, which were left before. Raises `InputError`, `JobError`, `DeviceError`."""
        with ExitStack() as stack:
            stack.enter_context(holding(self.loaded, "no unit yet"))
            connected = connect(self.loaded, attendant=attendant, past=past)
            stack.callback(connected.links.close)
            identity = StandIdentity(
                loaded=self.loaded,
                head=connected.stand.positioners[HEAD].identify(),
                daq=connected.stand.samplers[DAQ].identify(),
                status=connected.stand.positioners[HEAD].status(),
                warnings=connected.warnings,
            )
            self._connected, self._held = connected, stack.pop_all()
        return identity

    def disconnect(self) -> None:
        """Leave the instruments; raises what closing them raises."""
        self._connected = None
        self._held.close()

    def halt(self) -> None:
        """Tell the head to stop and read its rest back. Raises `DeviceError` where that could not be read."""
        if self._connected is None:
            return
        motion = self.motion
        with suppress(Exception):  # `standstill` says it again, over a link that it opens anew
            motion.brake()
        if not motion.standstill():
            remedy = "switch it off and look at it before you touch it"
            raise DeviceError("dividing head", "its standstill could not be read back", remedy)


def _place(loaded: LoadedStand) -> str:
    return str(loaded.path.resolve()) if loaded.path else ""
