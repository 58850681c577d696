"""Moving the head, and making sure of its standstill."""

import math
from collections.abc import Callable
from contextlib import suppress
from typing import Final

from drivers.clock import Clock
from drivers.errors import DeviceError
from drivers.protocols import DividingHead, HeadStatus
from procedures.steps import Direction

POLL_S: Final = 0.05
"""Time between two looks at the head or at the operator."""

_PATIENCE: Final = 2.0
_MARGIN_S: Final = 5.0
_STANDSTILL_S: Final = 10.0


class Motion:
    """Moves of one head.

    A move may take twice the time it should, plus 5 s. A standstill must be there within 10 s.
    """

    def __init__(self, head: DividingHead, clock: Clock, tolerance_deg: float) -> None:
        self._head = head
        self._clock = clock
        self._tolerance_deg = tolerance_deg
        self.direction: Direction = 0
        """Sign of the last move that was one; 0 before the first."""

    def travel(self, angle_deg: float, checkpoint: Callable[[], bool]) -> HeadStatus:
        """Go to `angle_deg` and return what the head reports once it stands there.

        `checkpoint` is called all along; it may raise, and returns true where it braked the head, which then sets out
        again.

        Raises
        ------
        LimitError, DeviceError
            Where the head refuses, or is not at rest at the angle in time.
        """
        deadline_s = self._depart(angle_deg)
        while True:
            status = self._head.status()
            if not status.moving and self._near(status.angle_deg, angle_deg):
                return status
            if self._clock.monotonic_s() > deadline_s:
                raise _late(status, angle_deg)
            self._clock.sleep(POLL_S)
            if checkpoint():
                deadline_s = self._depart(angle_deg)

    def brake(self) -> None:
        """Tell the head to stop. Raises `DeviceError`."""
        self._head.stop()

    def standstill(self) -> bool:
        """Read the head's rest back: twice in a row it is not moving, in the same place. Until then, tell it to stop.

        Never raises, whatever the head does: false says that no standstill could be read back within its time, or
        before somebody interrupted the program.
        """
        with suppress(KeyboardInterrupt):
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
            status = self._head.status()
            if not status.moving:
                return status.angle_deg
        with suppress(Exception):
            self._head.stop()
        return math.nan

    def _depart(self, angle_deg: float) -> float:
        """Set out and return the time by which the head must have arrived."""
        start_deg = self._head.status().angle_deg
        if not self._near(start_deg, angle_deg):
            self.direction = 1 if angle_deg > start_deg else -1
        self._head.start_move(angle_deg)
        move_s = abs(angle_deg - start_deg) / self._head.speed_deg_s
        return self._clock.monotonic_s() + _PATIENCE * move_s + _MARGIN_S

    def _near(self, first_deg: float, second_deg: float) -> bool:
        return abs(first_deg - second_deg) <= self._tolerance_deg


def _late(status: HeadStatus, angle_deg: float) -> DeviceError:
    doing = "still moves" if status.moving else "stands"
    return DeviceError(
        "dividing head",
        f"{doing} at {status.angle_deg:.4f} deg when it should long have stood at {angle_deg:g} deg",
        "look for what blocks it, check its drive and speed, then resume the run",
    )
