"""What an effect of a head that is measured against a reference may depend on."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.rows import Dwells

_STILL_DEG, _STILL_DEG_S = 1e-4, 1e-3
"""A head that reports less of a move, or less of a speed, is at rest."""
_GAP = 5.0
"""A gap so many times as wide as the usual one is where the head was not."""
_SHARED = 2
"""So many dwells of each direction at least lie where both were."""


@dataclass(frozen=True, kw_only=True)
class HeadScene:
    """Dwells as an effect sees them; what the table does not say is None."""

    dwells: Dwells
    late_s: float = 0.0
    """What is known so far of how late the reference is read: it saw the head where it was before."""
    short_deg: float = 0.0
    """What is known so far of the backlash: after moves in - direction the head stands elsewhere."""

    @property
    def rows(self) -> int:
        """How many there are."""
        return len(self.dwells.observations)

    @property
    def angle_deg(self) -> FloatArray:
        """Head angle as reported, any revolution."""
        return self.dwells.observations.angle_deg

    @cached_property
    def seen_deg(self) -> FloatArray:
        """Where the reference saw the head, by what is known so far, shape (rows,)."""
        return np.asarray(self.angle_deg + self.late_deg + self.short_deg * (self.direction < 0))

    @cached_property
    def late_deg(self) -> FloatArray:
        """How far from where it is the head was when the reference saw it, by what is known so far, shape (rows,)."""
        if not self.late_s or self.velocity_deg_s is None:
            return np.zeros(self.rows)
        return self.dwells.angle_before_deg(self.late_s, self.velocity_deg_s) - self.angle_deg

    @cached_property
    def late_deg_per_s(self) -> FloatArray | None:
        """The same for each second of being late; None where the table does not say how fast the head was."""
        velocity_deg_s = self.velocity_deg_s
        if velocity_deg_s is None:
            return None
        return np.asarray(self.late_deg / self.late_s if self.late_s else -velocity_deg_s)

    @cached_property
    def turns(self) -> FloatArray:
        """Head angle from the first row, in turns."""
        return np.asarray((self.angle_deg - self.angle_deg[0]) / 360.0)

    @cached_property
    def distinct_angles(self) -> int:
        """How many different degrees of the circle were visited: a circle carries no more numbers than that."""
        return len(np.unique(np.round(self.angle_deg % 360.0)))

    @cached_property
    def arc_deg(self) -> float:
        """How much of the circle was visited, of 360°: all but the widest gap, as far as that is no usual step."""
        at_deg = np.unique(np.round(self.angle_deg % 360.0, 3))
        gaps_deg = np.diff(at_deg, append=at_deg[0] + 360.0)
        widest_deg = float(gaps_deg.max())
        return 360.0 - widest_deg if widest_deg > _GAP * float(np.median(gaps_deg)) else 360.0

    @cached_property
    def both_ways(self) -> bool:
        """Whether some of the arc was visited from both sides, so that the direction is no function of the angle."""
        forward, backward = (self.angle_deg[self.direction == sign] for sign in (1, -1))
        if not len(forward) or not len(backward):
            return False
        low, high = max(forward.min(), backward.min()), min(forward.max(), backward.max())
        shared = [int(np.count_nonzero((side >= low) & (side <= high))) for side in (forward, backward)]
        return bool(high > low and min(shared) >= _SHARED)

    @cached_property
    def hours(self) -> FloatArray | None:
        """Time since the first row, in hours."""
        time_s = self.dwells.observations.time_s
        return None if time_s is None else (time_s - time_s[0]) / 3600.0

    @property
    def velocity_deg_s(self) -> FloatArray | None:
        """Speed of the head; None where neither the table nor a stream says."""
        return self.dwells.observations.velocity_deg_s

    @cached_property
    def direction(self) -> NDArray[np.int64]:
        """Sign of the last move of the head; 0 before the first."""
        stated, velocity = self.dwells.observations.direction, self.velocity_deg_s
        if stated is not None:
            return stated
        moved = np.diff(self.angle_deg, prepend=self.angle_deg[0])
        speed = moved if velocity is None else np.where(np.abs(velocity) > _STILL_DEG_S, velocity, moved)
        sign = np.where(np.abs(speed) > _STILL_DEG, np.sign(speed), 0).astype(np.int64)
        last = np.maximum.accumulate(np.where(sign != 0, np.arange(self.rows), 0))
        return np.asarray(sign[last])

    @cached_property
    def temperature_k(self) -> FloatArray | None:
        """Temperature above its mean, in kelvin; missing values are the mean."""
        measured = self.dwells.observations.temperature_degc
        if measured is None or not np.isfinite(measured).any():
            return None
        middle = float(np.nanmean(measured))
        return np.asarray(np.where(np.isfinite(measured), measured, middle) - middle)
