"""Moving the head, and making sure of its standstill."""

import math
from collections.abc import Callable
from contextlib import suppress
from typing import Final

from drivers.clock import Clock
from drivers.errors import DeviceError, LinkLostError, ReferenceLostError
from drivers.protocols import DividingHead, HeadStatus, Reconnectable
from procedures.approach import EITHER_WAY, Approach, Place, direction_of
from procedures.steps import Direction

POLL_S: Final = 0.05
"""Time between two looks at the head or at the operator."""

_PATIENCE: Final = 2.0
_MARGIN_S: Final = 5.0
_STALL_S: Final = 2.0
_STANDSTILL_S: Final = 10.0
_HOMING_S: Final = 60.0
_HALF_TURN_DEG: Final = 180.0


class Motion:
    """Moves of one head.

    A move may take twice the time it should, plus 5 s, and a head that rests elsewhere for 2 s has not arrived. A
    standstill must be there within 10 s; a reference within the time of two passes over all angles, plus 60 s. A head
    that a person turns may take its time, and stands where that person reads it.
    """

    def __init__(self, head: DividingHead, clock: Clock, tolerance_deg: float, approach: Approach = EITHER_WAY) -> None:
        self._head = head
        self._clock = clock
        self._tolerance_deg = tolerance_deg
        self._approach = approach
        self.direction: Direction = 0
        """Sign of the last move that was one; 0 before the first, and after the head was homed."""
        self.place: Place | None = None
        """Where the last journey ended; None before the first."""

    def travel(self, angle_deg: float, checkpoint: Callable[[], bool]) -> HeadStatus:
        """Go to `angle_deg` as the programme wants to arrive, and return what the head reports once it stands there.

        `checkpoint` is called all along; it may raise, and returns true where it braked the head, which then sets out
        again.

        Raises
        ------
        LimitError, DeviceError
            Where the head refuses, or is not at rest at the angle in time; `ReferenceLostError` where it has lost it.
        """
        return self._journey(angle_deg, self._approach, checkpoint)

    def return_to(self, place: Place, checkpoint: Callable[[], bool]) -> HeadStatus:
        """Go back to a place and arrive there in the direction of then. Raises as `travel`."""
        return self._journey(place.angle_deg, Approach(direction=place.direction), checkpoint)

    def unwind(self, checkpoint: Callable[[], bool]) -> None:
        """Turn a head that is more than half a turn from its zero back into that revolution, for the sake of its cable.

        A person who turns the head is not asked to. Raises as `travel`.
        """
        status = self._head.status()
        turns = round(status.angle_deg / 360.0)
        if turns and not status.by_hand and abs(status.angle_deg) > _HALF_TURN_DEG:
            self._journey(status.angle_deg - 360.0 * turns, EITHER_WAY, checkpoint)

    def home(self, checkpoint: Callable[[], bool]) -> None:
        """Bring the head to rest, have it find its reference and wait for that; `checkpoint` as in `travel`.

        Raises
        ------
        DeviceError
            Where the head does not come to rest, or finds no reference in time.
        """
        self.brake()
        if not self.standstill():
            raise DeviceError("dividing head", "cannot be brought to rest to be homed", "switch it off and look at it")
        deadline_s = self._begin_homing()
        while (status := self._head.status()).moving or not status.referenced:
            if self._clock.monotonic_s() > deadline_s:
                raise DeviceError(
                    "dividing head",
                    "was told to find its reference, and has not found it in time",
                    "look at its home sensor and at its drive, then resume the run",
                )
            self._clock.sleep(POLL_S)
            if checkpoint():
                deadline_s = self._begin_homing()
        self.direction = 0

    def check_rest(self, angle_deg: float) -> None:
        """Make sure that the head still stands where it was sent. Raises `DeviceError`."""
        status = self._referenced_status()
        if status.moving or not self._at(status, angle_deg):
            raise DeviceError(
                "dividing head",
                f"was to stand at {angle_deg:g} deg for a dwell, and is at {status.angle_deg:.4f} deg after it",
                "look for what turns it, then resume the run",
            )

    def brake(self) -> None:
        """Tell the head to stop. Raises `DeviceError`."""
        self._head.stop()

    def standstill(self) -> bool:
        """Read the head's rest back: twice in a row it is not moving, in the same place. Until then, tell it to stop.

        A link that is lost is opened anew. Raises nothing, whatever the head does: false says that no standstill could
        be read back within its time.
        """
        deadline_s = self._clock.monotonic_s() + _STANDSTILL_S
        rested_deg = math.nan
        while self._clock.monotonic_s() <= deadline_s:
            angle_deg = self._resting_angle_deg()
            if self._near(angle_deg, rested_deg):
                return True
            rested_deg = angle_deg
            self._clock.sleep(POLL_S)
        return False

    def _resting_angle_deg(self) -> float:
        """Angle at which the head says it stands; NaN, which is near to nothing, where it does not say so."""
        with suppress(Exception):
            try:
                status = self._head.status()
                if not status.moving:
                    return status.angle_deg
            except LinkLostError:
                if isinstance(self._head, Reconnectable):
                    self._head.reconnect()
        with suppress(Exception):
            self._head.stop()
        return math.nan

    def _journey(self, angle_deg: float, approach: Approach, checkpoint: Callable[[], bool]) -> HeadStatus:
        here = Place(angle_deg=self._referenced_status().angle_deg, direction=self.direction)
        low_deg, high_deg = self._head.limits_deg
        for waypoint_deg in approach.waypoints_deg(here, angle_deg, self._tolerance_deg)[:-1]:
            self._go(min(max(waypoint_deg, low_deg), high_deg), checkpoint)
        status = self._go(angle_deg, checkpoint)
        self.place = Place(angle_deg=status.angle_deg, direction=self.direction)
        return status

    def _go(self, angle_deg: float, checkpoint: Callable[[], bool]) -> HeadStatus:
        deadline_s = self._depart(angle_deg)
        stalled_s = math.inf
        while True:
            status = self._referenced_status()
            now_s = self._clock.monotonic_s()
            if not status.moving and self._at(status, angle_deg):
                return status
            stalled_s = math.inf if status.moving else min(stalled_s, now_s + _STALL_S)
            if now_s > min(deadline_s, stalled_s) and not status.by_hand:
                raise _late(status, angle_deg)
            self._clock.sleep(POLL_S)
            if checkpoint():
                deadline_s, stalled_s = self._depart(angle_deg), math.inf

    def _depart(self, angle_deg: float) -> float:
        """Set out and return the time by which the head must have arrived."""
        start_deg = self._referenced_status().angle_deg
        if not self._near(start_deg, angle_deg):
            self.direction = direction_of(angle_deg - start_deg)
        self._head.start_move(angle_deg)
        return self._clock.monotonic_s() + self._allowed_s(abs(angle_deg - start_deg))

    def _begin_homing(self) -> float:
        """Send the head to its reference and return the time by which it must have found it."""
        low_deg, high_deg = self._head.limits_deg
        self._head.home()
        return self._clock.monotonic_s() + self._allowed_s(high_deg - low_deg) + _HOMING_S

    def _allowed_s(self, way_deg: float) -> float:
        return _PATIENCE * way_deg / self._head.speed_deg_s + _MARGIN_S

    def _referenced_status(self) -> HeadStatus:
        status = self._head.status()
        if not status.referenced:
            raise ReferenceLostError(
                "dividing head", "has lost its reference", "look at its power supply, then resume the run"
            )
        return status

    def _at(self, status: HeadStatus, angle_deg: float) -> bool:
        return status.by_hand or self._near(status.angle_deg, angle_deg)

    def _near(self, first_deg: float, second_deg: float) -> bool:
        return abs(first_deg - second_deg) <= self._tolerance_deg


def _late(status: HeadStatus, angle_deg: float) -> DeviceError:
    doing = "still moves" if status.moving else "stands"
    return DeviceError(
        "dividing head",
        f"{doing} at {status.angle_deg:.4f} deg when it should long have stood at {angle_deg:g} deg",
        "look for what blocks it, check its drive and speed, then resume the run",
    )
