"""The axis behind an emulated drive: the simulated head, counted in position units, and what may go wrong with it."""

from typing import Final

from tumble.drivers.errors import LimitError
from tumble.drivers.protocols import PositionerStatus
from tumble.emulators.faults import Faults
from tumble.emulators.world import SharedWorld

OVERSHOOT_DEG: Final = 0.5


class Axis:
    """The simulated head as the drive drives it. A power loss loses the count until the axis has been homed.

    A stalled axis stays where it is half-way; one that overshoots believes itself at its target.
    """

    def __init__(self, world: SharedWorld, faults: Faults, steps_per_deg: float) -> None:
        self._world = world
        self._faults = faults
        self._steps_per_deg = steps_per_deg
        self._zero_deg = 0.0
        self._homing = False
        self._arrives = True
        self.homed = False
        """Whether the count is true."""
        self.blocked = False
        """Whether it lags behind its set-point for good."""

    @property
    def counts(self) -> int:
        """Position by the encoder."""
        return round((self._status().angle_deg - self._zero_deg) * self._steps_per_deg)

    @property
    def counts_per_s(self) -> int:
        """Velocity."""
        with self._world.lock:
            head = self._world.head
            speed_deg_s = head.direction * head.speed_deg_s if head.status().moving else 0.0
        return round(speed_deg_s * self._steps_per_deg)

    @property
    def limits_counts(self) -> tuple[int, int]:
        """Least and greatest target."""
        low, high = sorted(limit_deg * self._steps_per_deg for limit_deg in self._world.head.limits_deg)
        return round(low), round(high)

    @property
    def arrived(self) -> bool:
        """Whether it stands where it was sent, as far as the drive knows."""
        return self._arrives and not self.blocked and not self._homing and not self._status().moving

    def move_to(self, counts: int) -> None:
        """Set out for a target."""
        fault = self._faults.take("stall", "overshoot", "moving_for_ever")
        kind = fault.kind if fault else ""
        with self._world.lock:
            here_deg = self._status().angle_deg
            target_deg = counts / self._steps_per_deg + self._zero_deg
            self._homing = False
            self._arrives = kind != "moving_for_ever"
            self.blocked = kind == "stall"
            if self.blocked:
                target_deg = (here_deg + target_deg) / 2
            elif kind == "overshoot":
                target_deg += OVERSHOOT_DEG if target_deg >= here_deg else -OVERSHOOT_DEG
            self._start(target_deg)

    def home(self) -> None:
        """Look for the reference; stalled on its way it never finds it, and moving for ever it never says so."""
        fault = self._faults.take("stall", "moving_for_ever")
        kind = fault.kind if fault else ""
        with self._world.lock:
            here_deg = self._status().angle_deg
            self.homed, self.blocked = False, kind == "stall"
            self._homing, self._arrives = kind == "", kind != "moving_for_ever"
            self._world.head.home()
            if self.blocked:
                self._start(here_deg / 2)

    def stop(self) -> None:
        """Halt."""
        with self._world.lock:
            self._world.head.stop()
            self._homing, self._arrives, self.blocked = False, True, False

    def lose_power(self) -> None:
        """Halt and forget the count, which begins again at 0."""
        self.stop()
        self.homed = self.blocked = False
        self._zero_deg = self._status().angle_deg

    def update(self) -> bool:
        """Look whether homing is done; return true where the axis has got stuck on its way."""
        standing = not self._status().moving
        if self._homing and standing:
            self._homing, self.homed, self._zero_deg = False, True, 0.0
        return self.blocked and standing

    def _start(self, angle_deg: float) -> None:
        low_deg, high_deg = self._world.head.limits_deg
        try:
            self._world.head.start_move(min(max(angle_deg, low_deg), high_deg))
        except LimitError:  # not a number: the axis stays
            self._world.head.stop()

    def _status(self) -> PositionerStatus:
        with self._world.lock:
            return self._world.head.status()
