"""The axis of an emulated Zaber stage: motion, reference and warnings."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Final

from tumble.drivers.errors import LimitError
from tumble.emulators.faults import Faults
from tumble.emulators.world import SharedWorld

OVERSHOOT_DEG: Final = 0.5
SPEED_UNITS_PER_HZ: Final = 1.6384

_BY_SEVERITY: Final = ("FS", "WR", "WH", "NI")


class RejectError(Exception):
    """A command is refused; the text is the reason as the device gives it."""


class ZaberAxis:
    """Turns the head of a world. Whoever calls it holds the world's lock and has it look first.

    It is switched on without a reference: it then calls zero whatever angle it stands at, until it has been homed. Its
    faults begin with the next move: it stalls halfway, stops half a degree too far, or stays BUSY until told to stop.
    """

    def __init__(self, shared: SharedWorld, steps_per_deg: float, faults: Faults) -> None:
        self._head = shared.head
        self._clock = shared.clock
        self._steps_per_deg = steps_per_deg
        self.faults = faults
        """What goes wrong in it."""
        self._flags = {"WR", "WH"}
        self._angle_deg = self._zero_deg = self._head.status().angle_deg
        self._speed_deg_s = self._head.speed_deg_s
        self._homing = False
        self._for_ever = False
        self._stalls_at_s: float | None = None
        self.busy = False
        """Whether it moved at the last look."""
        self.arrivals = 0
        """How often it has come to rest."""
        self.arrived_s = 0.0
        """When it last did, by the clock of the world."""

    @property
    def flag(self) -> str:
        """The most severe warning flag, `--` for none."""
        return most_severe(self._flags)

    def look(self) -> None:
        """See what has come of the motion until now: state and position are of the same moment."""
        if self._stalls_at_s is not None and self._clock.monotonic_s() >= self._stalls_at_s:
            self._head.move = self._head.move.halted(self._stalls_at_s)
            self._flags.add("FS")
            self._halt()
        seen = self._head.status()
        self._angle_deg = seen.angle_deg
        moved, self.busy = self.busy, self._for_ever or seen.moving
        if moved and not self.busy:
            self._arrive()

    def settings(self) -> dict[str, int]:
        """What can be asked of the axis."""
        limits = sorted(round(limit_deg * self._steps_per_deg) for limit_deg in self._head.limits_deg)
        steps_per_s = self._speed_deg_s * abs(self._steps_per_deg)
        return {
            "pos": round((self._angle_deg - self._zero_deg) * self._steps_per_deg),
            "limit.min": limits[0],
            "limit.max": limits[1],
            "maxspeed": round(steps_per_s * SPEED_UNITS_PER_HZ),
        }

    def set_speed(self, text: str) -> None:
        """Set the speed of the moves to come."""
        speed = _number(text)
        if speed <= 0:
            raise RejectError("BADDATA")
        self._speed_deg_s = speed / SPEED_UNITS_PER_HZ / abs(self._steps_per_deg)

    def home(self, arguments: Sequence[str]) -> str:
        """Look for the reference."""
        if arguments:
            raise RejectError("BADCOMMAND")
        self._leave()
        self._homing = True
        self._head.home()
        self._set_out()
        return "0"

    def go(self, arguments: Sequence[str]) -> str:
        """Move to a place, by a distance, or to a limit."""
        steps = self._target(arguments)
        limits = self.settings()
        if "WR" in self._flags or not limits["limit.min"] <= steps <= limits["limit.max"]:
            raise RejectError("BADDATA")
        self._leave()
        angle_deg = steps / self._steps_per_deg
        try:
            self._head.start_move(self._overshot(angle_deg))
        except LimitError as error:
            raise RejectError("BADDATA") from error
        self._set_out()
        return "0"

    def stop(self, arguments: Sequence[str]) -> str:
        """Stand still where it is."""
        if arguments:
            raise RejectError("BADCOMMAND")
        if self.busy:
            self._flags.add("NI")
        self._halt()
        self.look()
        return "0"

    def warnings(self, arguments: Sequence[str]) -> str:
        """List all flags; `clear` forgets those whose cause is over."""
        if arguments and list(arguments) != ["clear"]:
            raise RejectError("BADCOMMAND")
        flags = [flag for flag in _BY_SEVERITY if flag in self._flags]
        if arguments:
            self._flags &= {"WR", "WH"}
        return " ".join([f"{len(flags):02d}", *flags])

    def lose_power(self) -> None:
        """Be switched off and on: it stands, and does not know where."""
        self._halt()
        self.look()
        self._flags = {"WR", "WH"}
        self._zero_deg = self._angle_deg

    def _target(self, arguments: Sequence[str]) -> int:
        match list(arguments):
            case ["abs", text]:
                return _number(text)
            case ["rel", text]:
                return self.settings()["pos"] + _number(text)
            case ["min" | "max" as end]:
                return self.settings()[f"limit.{end}"]
            case ["abs" | "rel"]:
                raise RejectError("BADDATA")
        raise RejectError("BADCOMMAND")

    def _leave(self) -> None:
        """End what it does now in favour of something else."""
        self._flags.discard("NI")
        if self.busy:
            self._flags.add("NI")
        self._halt()

    def _set_out(self) -> None:
        self._head.move = replace(self._head.move, speed_deg_s=self._speed_deg_s)
        self.busy = True
        self._for_ever = self.faults.take("moving_for_ever") is not None
        if self.faults.take("stall"):
            move = self._head.move
            self._stalls_at_s = (move.started_s + move.ended_s) / 2.0
        self.look()

    def _overshot(self, angle_deg: float) -> float:
        """The angle where it will stop in place of another."""
        if not self.faults.take("overshoot"):
            return angle_deg
        low_deg, high_deg = self._head.limits_deg
        further_deg = OVERSHOOT_DEG if angle_deg >= self._angle_deg else -OVERSHOOT_DEG
        return min(max(angle_deg + further_deg, low_deg), high_deg)

    def _arrive(self) -> None:
        self.arrivals += 1
        self.arrived_s = self._clock.monotonic_s()
        if self._homing:
            self._homing = False
            self._zero_deg = 0.0
            self._flags -= {"WR", "WH"}

    def _halt(self) -> None:
        """Whatever it does, it does no more; a search for the reference that is broken off has found none."""
        self._for_ever = False
        self._homing = False
        self._stalls_at_s = None
        self._head.stop()


def most_severe(flags: Collection[str]) -> str:
    """The most severe of some warning flags, `--` for none."""
    return next((flag for flag in _BY_SEVERITY if flag in flags), "--")


def _number(text: str) -> int:
    try:
        return int(text)
    except ValueError as error:
        raise RejectError("BADDATA") from error
