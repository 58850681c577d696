"""What goes wrong at an emulated stand, and when: a script, and the object that says when its time has come.

    [[fault]]
    device = "head"
    kind = "drop"
    at = { command = 3, containing = "move abs" }
    lasts_s = 2.0

The wire faults (`WIRE`, `drop`) are applied by `serving`; an emulated instrument asks for its own.
"""

from collections.abc import Callable, Sequence
from threading import Lock
from typing import Final, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from tumble.drivers.clock import Clock, SystemClock
from tumble.drivers.names import GivenName
from tumble.messages import Message

WireKind = Literal["late", "cut", "double", "garble", "reorder", "wrong_checksum"]
"""What may happen to an answer on its way."""

DeviceKind = Literal[
    "stall",
    "overshoot",
    "moving_for_ever",
    "power_loss",
    "nan",
    "overload",
    "frames_lost",
    "bus_off",
    "heartbeat_lost",
    "emergency",
    "error_queued",
    "swapped",
    "old_bits",
    "flicker",
    "without_options",
    "mode_shown_late",
    "foreign_frames",
    "door_opened",
    "sensor_broken",
    "stuck",
    "alarm",
    "refused",
    "stale",
    "other_unit",
]
"""What may happen in an instrument.

`emergency`: a drive gets too hot, says so and goes into fault. `error_queued`: a multimeter has an error in its queue.
`swapped`: another unit, with another serial number, stands in its place.
`old_bits`, `flicker`, `without_options`, `mode_shown_late`: a CiA 402 drive has that habit from then on
(`tumble.emulators.cia402_habits`). `foreign_frames`: frames that are cut, garbled or of another kind come under the
identifiers of a device on CAN. Of a temperature chamber, for `lasts_s`: `door_opened`; `sensor_broken`, whose
temperature is then the end of its scale; `stuck`, whose air stays as it is; `alarm`; once: `refused`, a set point that
is not taken.
"""

Kind = Literal[WireKind, "drop", "noise", DeviceKind, "not_seated"]
"""Any fault. `drop`: the link vanishes and returns; the last command was heard, its answer was not. `noise`: bytes that
mean nothing come from the line, or from the adapter or server of a CAN bus. `not_seated`: the operator confirms a mount
and leaves the unit as it sits."""

WIRE: Final[tuple[WireKind, ...]] = ("late", "cut", "double", "garble", "reorder", "wrong_checksum")

_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class At(BaseModel):
    """When a fault happens: at a point, a command or a time; whichever of the three is given."""

    model_config = _STRICT

    point: int | None = Field(default=None, ge=0)
    """So many dwells have begun."""
    command: int | None = Field(default=None, ge=1)
    """The instrument hears this command, counted from 1."""
    time_s: float | None = Field(default=None, ge=0.0)
    """Seconds of the world's clock since the emulator began."""
    containing: str = ""
    """Only commands that contain this text are counted, and hit."""

    @model_validator(mode="after")
    def _one_of_three(self) -> Self:
        if sum(given is not None for given in (self.point, self.command, self.time_s)) != 1:
            raise ValueError(Message("a fault happens at one of point, command and time_s; give exactly one of them"))
        if self.containing and self.command is None:
            raise ValueError(Message("containing chooses among commands; give command, too, or leave it out"))
        return self


class Fault(BaseModel):
    """One thing that goes wrong."""

    model_config = _STRICT

    device: GivenName
    """Name of the instrument at the stand, `head` or `daq`, say; or `operator`, or `chamber`."""
    kind: Kind
    at: At
    lasts_s: float = Field(default=1.0, ge=0.0)
    """How long it lasts, or how late an answer is, in seconds of the computer, not of the world."""
    times: int = Field(default=1, ge=1)
    """How often in a row, from then on."""


class FaultScript(BaseModel):
    """All that goes wrong: the contents of a fault file."""

    model_config = _STRICT

    fault: tuple[Fault, ...] = ()


class Faults:
    """Says which fault of one instrument is due. May be asked from several threads.

    Parameters
    ----------
    script
        What shall go wrong; nothing by default.
    device
        Whose faults these are.
    clock
        Clock of the world.
    points
        Tells how many dwells have begun in the world.
    """

    def __init__(
        self,
        script: FaultScript | None = None,
        device: str = "head",
        clock: Clock | None = None,
        points: Callable[[], int] = lambda: 0,
    ) -> None:
        faults = script.fault if script else ()
        self._pending = [_Pending(fault) for fault in faults if fault.device == device]
        self._clock = clock or SystemClock()
        self._points = points
        self._began_s = self._clock.monotonic_s()
        self._lock = Lock()
        self.happened: list[tuple[float, Fault]] = []
        """What went wrong so far, with the time of the clock."""

    def add(self, fault: Fault) -> None:
        """Have one more thing go wrong; `at` counts commands from now on."""
        with self._lock:
            self._pending.append(_Pending(fault))

    def note_command(self, command: bytes) -> None:
        """Count a command that the instrument has heard."""
        with self._lock:
            for pending in self._pending:
                pending.note(command)

    def take(self, *kinds: Kind) -> Fault | None:
        """The first fault of these kinds that is due now; it counts as having happened."""
        with self._lock:
            for pending in self._pending:
                if pending.fault.kind in kinds and pending.left and self._due(pending):
                    pending.left -= 1
                    self.happened.append((self._clock.monotonic_s(), pending.fault))
                    return pending.fault
        return None

    def _due(self, pending: "_Pending") -> bool:
        at = pending.fault.at
        if at.command is not None:
            return pending.hit and pending.commands >= at.command
        if at.point is not None:
            return self._points() >= at.point
        return at.time_s is not None and self._clock.monotonic_s() - self._began_s >= at.time_s


class JointFaults(Faults):
    """The faults of several instruments on one line: what happens to its bytes may be due for any of them."""

    def __init__(self, members: Sequence[Faults]) -> None:
        super().__init__()
        self._members = members

    def note_command(self, command: bytes) -> None:
        """Count a command that all of them have heard."""
        for member in self._members:
            member.note_command(command)

    def take(self, *kinds: Kind) -> Fault | None:
        """The first fault of these kinds that is due now for any of them."""
        return next((fault for member in self._members if (fault := member.take(*kinds))), None)


class _Pending:
    """A fault that has yet to happen, with the commands that it has seen."""

    def __init__(self, fault: Fault) -> None:
        self.fault = fault
        self.left = fault.times
        self.commands = 0
        self.hit = False
        """Whether the present command is one that it counts."""

    def note(self, command: bytes) -> None:
        self.hit = self.fault.at.containing.encode() in command
        self.commands += self.hit
