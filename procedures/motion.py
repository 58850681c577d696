"""Moving one positioner, and making sure of its standstill."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Final

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LinkLostError, ReferenceLostError
from tumble.drivers.protocols import Positioner, PositionerStatus, Reconnectable
from tumble.messages import Message
from tumble.procedures.approach import EITHER_WAY, Approach, Place, direction_of
from tumble.procedures.errors import StopRequestedError
from tumble.procedures.journeys import POLL_S, Journey, together
from tumble.procedures.steps import Direction
from tumble.procedures.watch import Watch, allowed_s

_STANDSTILL_S: Final = 10.0
_HOMING_S: Final = 60.0
_HALF_TURN_DEG: Final = 180.0


class Motion:
    """Moves of one positioner, which sentences call `title`.

    Every move is watched, see `Watch`. A standstill must be there within 10 s; a reference within the time of two
    passes over all angles, plus 65 s. One that a person turns may take its time, and stands where it is read.
    `look` is shown where it is whenever that is read on its way, and where it was sent.
    """

    def __init__(
        self,
        head: Positioner,
        clock: Clock,
        tolerance_deg: float,
        approach: Approach = EITHER_WAY,
        look: Callable[[PositionerStatus], None] = lambda _: None,
        *,
        title: str,
    ) -> None:
        self._head = head
        self._clock = clock
        self._tolerance_deg = tolerance_deg
        self._approach = approach
        self._look = look
        self.title = title
        """What sentences call it."""
        self.direction: Direction = 0
        """Sign of the last move that was one; 0 before the first, and after the head was homed."""
        self._target_deg: float | None = None
        self.under_way = False
        """Whether it was sent somewhere and has not arrived yet."""
        self.place: Place | None = None
        """Where the last journey ended; None before the first."""

    def travel(self, angle_deg: float, checkpoint: Callable[[], bool]) -> PositionerStatus:
        """Go to `angle_deg` as the programme wants to arrive, and return what the head reports once it stands there.

        `checkpoint` is called all along; it may raise, and returns true where it braked the head, which then sets out
        again.

        Raises
        ------
        LimitError, DeviceError
            Where the head refuses, or is not at rest at the angle in time; `ReferenceLostError` where it has lost it.
        """
        return self._made(self.journey(angle_deg), checkpoint)

    def return_to(self, place: Place, checkpoint: Callable[[], bool]) -> PositionerStatus:
        """Go back to a place and arrive there in the direction of then. Raises as `travel`."""
        return self._made(self.way_back(place), checkpoint)

    def journey(self, angle_deg: float) -> Journey:
        """What `travel` does, under way beside others."""
        return self._journey(angle_deg, self._approach)

    def way_back(self, place: Place) -> Journey:
        """What `return_to` does, likewise.

        Where it came from its reference alone, it comes from there again, unless the programme says from which side.
        """
        direction = place.direction or self._approach.direction
        if not direction and self.direction and not self._head.status().by_hand:
            yield from self._homing()
        return (yield from self._journey(place.angle_deg, Approach(direction=direction)))

    def unwind(self, checkpoint: Callable[[], bool]) -> None:
        """Turn a head that is more than half a turn from its zero back into that revolution, for the sake of its cable.

        Where its limits do not allow that, it is turned back as far as they do. A person who turns the head is not
        asked to. Raises as `travel`.
        """
        self._made(self._unwinding(), checkpoint)

    def home(self, checkpoint: Callable[[], bool]) -> None:
        """Bring the head to rest, have it find its reference and wait for that; `checkpoint` as in `travel`.

        A head that still knows its angle unwinds its cable first: it may find its reference in any revolution, and
        call that the first.

        Raises
        ------
        DeviceError
            Where the head does not come to rest, or finds no reference in time.
        """
        self._made(self._homing(), checkpoint)

    def check_rest(self, angle_deg: float) -> None:
        """Make sure that the head still stands where it was sent. Raises `DeviceError`."""
        status = self._referenced_status()
        if status.moving or not self._at(status, angle_deg):
            raise DeviceError(
                self.title,
                Message(
                    "was to stand at {angle_deg:g} deg for a dwell, and is at {reported_deg:.4f} deg after it",
                    angle_deg=angle_deg,
                    reported_deg=status.angle_deg,
                ),
                Message("look for what turns it, then resume the run"),
            )

    def brake(self) -> None:
        """Tell the head to stop. Raises `DeviceError`."""
        self._head.stop()

    def halt(self) -> None:
        """Tell the head to stop and read its rest back. Raises `DeviceError` where it does not come to rest."""
        self.brake()
        if not self.standstill():
            raise DeviceError(self.title, Message("cannot be brought to rest"), Message("switch it off and look at it"))

    def standstill(self) -> bool:
        """Read the head's rest back: twice in a row it is not moving, in the same place. Until then, tell it to stop.

        A link that is lost is opened anew. Raises nothing, whatever the head does, but where somebody has the wait
        broken off: false says that no standstill could be read back within its time.
        """
        return standstill([self], self._clock)

    def rests_at(self, angle_deg: float) -> tuple[bool, float]:
        """Whether it rests where it rested, and where it does; NaN, which is near to nothing, where it does not.

        One that does not say so is told to stop. Raises as `standstill`.
        """
        resting_deg = self._resting_angle_deg()
        return self._near(resting_deg, angle_deg), resting_deg

    def _resting_angle_deg(self) -> float:
        """Angle at which the head says it stands; NaN, which is near to nothing, where it does not say so."""
        with _whatever_it_does():
            try:
                status = self._head.status()
                self._see(status)  # whoever watches sees where it came to rest
                if not status.moving:
                    return status.angle_deg
            except LinkLostError:
                if isinstance(self._head, Reconnectable):
                    self._head.reconnect()
        with _whatever_it_does():
            self._head.stop()
        return math.nan

    def _made(self, journey: Journey, checkpoint: Callable[[], bool]) -> PositionerStatus:
        (status,) = together([journey], self._clock, checkpoint)
        return status

    def _unwinding(self) -> Journey:
        status = self._head.status()
        unwound_deg = self._unwound_deg(status.angle_deg)
        if status.by_hand or unwound_deg == status.angle_deg:
            return status
        return (yield from self._journey(unwound_deg, EITHER_WAY))

    def _homing(self) -> Journey:
        self.halt()
        if self._head.status().referenced:
            yield from self._unwinding()
        deadline_s = self._begin_homing()
        while (status := self._head.status()).moving or not status.referenced:
            self._see(status)
            if self._clock.monotonic_s() > deadline_s:
                raise DeviceError(
                    self.title,
                    Message("was told to find its reference, and has not found it in time"),
                    Message("look at its home sensor and at its drive, then resume the run"),
                )
            if (yield):
                deadline_s = self._begin_homing()
        self.direction, self.under_way = 0, False
        return status

    def _journey(self, angle_deg: float, approach: Approach) -> Journey:
        here = Place(angle_deg=self._referenced_status().angle_deg, direction=self.direction)
        low_deg, high_deg = self._head.limits_deg
        for waypoint_deg in approach.waypoints_deg(here, angle_deg, self._tolerance_deg)[:-1]:
            yield from self._go(min(max(waypoint_deg, low_deg), high_deg))
        status = yield from self._go(angle_deg)
        self.place = Place(angle_deg=status.angle_deg, direction=self.direction)
        return status

    def _go(self, angle_deg: float) -> Journey:
        watch = self._depart(angle_deg)
        while True:
            status = self._referenced_status()
            if not status.moving and self._at(status, angle_deg):
                self.under_way = False
                return status
            if not status.by_hand:
                watch.look(status, self._clock.monotonic_s())
            if (yield):
                watch = self._depart(angle_deg)

    def _depart(self, angle_deg: float) -> Watch:
        """Set out, and have the way watched."""
        start_deg = self._referenced_status().angle_deg
        if not self._near(start_deg, angle_deg):
            self.direction = direction_of(angle_deg - start_deg)
        self._target_deg, self.under_way = angle_deg, True
        self._head.start_move(angle_deg)
        return Watch(
            start_deg,
            angle_deg,
            speed_deg_s=self._head.speed_deg_s,
            tolerance_deg=self._tolerance_deg,
            now_s=self._clock.monotonic_s(),
            title=self.title,
        )

    def _unwound_deg(self, angle_deg: float) -> float:
        """The same pose with the fewest turns that the limits allow."""
        low_deg, high_deg = self._head.limits_deg
        turns = round(angle_deg / 360.0) if abs(angle_deg) > _HALF_TURN_DEG else 0
        fewer = range(turns, 0, -1 if turns > 0 else 1)
        poses_deg = (angle_deg - 360.0 * fewer_turns for fewer_turns in fewer)
        return next((pose_deg for pose_deg in poses_deg if low_deg <= pose_deg <= high_deg), angle_deg)

    def _begin_homing(self) -> float:
        """Send the head to its reference and return the time by which it must have found it."""
        low_deg, high_deg = self._head.limits_deg
        self._target_deg, self.under_way = None, True
        self._head.home()
        return self._clock.monotonic_s() + allowed_s(high_deg - low_deg, self._head.speed_deg_s) + _HOMING_S

    def _referenced_status(self) -> PositionerStatus:
        status = self._head.status()
        self._see(status)
        if not status.referenced:
            raise ReferenceLostError(
                self.title, Message("has lost its reference"), Message("look at its power supply, then resume the run")
            )
        return status

    def _see(self, status: PositionerStatus) -> None:
        self._look(replace(status, target_deg=self._target_deg))

    def _at(self, status: PositionerStatus, angle_deg: float) -> bool:
        return status.by_hand or self._near(status.angle_deg, angle_deg)

    def _near(self, first_deg: float, second_deg: float) -> bool:
        return abs(first_deg - second_deg) <= self._tolerance_deg


@contextmanager
def _whatever_it_does() -> Iterator[None]:
    """Bear whatever a head raises; not what ends the wait for it."""
    try:
        yield
    except StopRequestedError:
        raise
    except Exception:  # it is asked again, until its time is over
        return


def standstill(motions: Sequence[Motion], clock: Clock) -> bool:
    """Read the rest of several positioners back, as `Motion.standstill` does; false where one may still move."""
    deadline_s = clock.monotonic_s() + _STANDSTILL_S
    rested_deg = dict.fromkeys(motions, math.nan)
    while clock.monotonic_s() <= deadline_s:
        for motion, angle_deg in list(rested_deg.items()):
            rests, rested_deg[motion] = motion.rests_at(angle_deg)
            if rests:
                del rested_deg[motion]
        if not rested_deg:
            return True
        clock.sleep(POLL_S)
    return False
