"""From which side the head comes to an angle: a head with backlash is always brought there from the same one."""

from dataclasses import dataclass
from typing import Final

from tumble.procedures.steps import Direction


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where the head stands, and the sign of the move that brought it there."""

    angle_deg: float
    direction: Direction


@dataclass(frozen=True, kw_only=True)
class Approach:
    """The direction of the last move to every angle; 0 leaves it to where the head comes from."""

    direction: Direction = 0
    overshoot_deg: float = 2.0
    """How far the head goes beyond an angle, to come back to it in the right direction."""

    def waypoints_deg(self, here: Place, angle_deg: float, tolerance_deg: float) -> tuple[float, ...]:
        """Angles to go to in turn, the last of them `angle_deg`, for a head that stands at `here`."""
        way_deg = angle_deg - here.angle_deg
        natural = here.direction if abs(way_deg) <= tolerance_deg else direction_of(way_deg)
        if self.direction in (0, natural):
            return (angle_deg,)
        return (angle_deg - self.direction * self.overshoot_deg, angle_deg)


EITHER_WAY: Final = Approach()


def direction_of(way_deg: float) -> Direction:
    """Sign of a move that is not zero."""
    return 1 if way_deg > 0 else -1
