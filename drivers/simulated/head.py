"""The simulated dividing head: how it moves, what it reports, and by how much the truth differs."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.limits import check_limits
from tumble.drivers.protocols import Identity, PositionerStatus
from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.external import HeadError
from tumble.drivers.simulated.geometry import FloatArray
from tumble.messages import Message

DEVICE = Message("simulated head")
ROUNDING_S = 1e-9
"""A move that ends sooner than this has ended: clock times are sums of floating-point numbers."""


@dataclass(frozen=True, kw_only=True)
class HeadOptions:
    """What the `[head]` table of a stand file says of the head."""

    limits_deg: tuple[float, float] = (-180.0, 760.0)
    steps_per_deg: float = 1000.0
    """Counts per degree, sign included."""
    speed_deg_s: float = 20.0

    def on_the_grid(self, angle_deg: float) -> float:
        """Nearest angle that the head can count, in degrees."""
        return round(angle_deg * self.steps_per_deg) / self.steps_per_deg


@dataclass(frozen=True, kw_only=True)
class Move:
    """Travel at constant speed from one angle to another; standing still is a move of no length."""

    start_deg: float
    end_deg: float
    started_s: float
    speed_deg_s: float

    @property
    def ended_s(self) -> float:
        """Clock time of arrival."""
        return self.started_s + abs(self.end_deg - self.start_deg) / self.speed_deg_s

    def angle_deg(self, time_s: float) -> float:
        """Angle of the head at a clock time."""
        if time_s >= self.ended_s:
            return self.end_deg
        travel_deg = self.speed_deg_s * max(time_s - self.started_s, 0.0)
        return self.start_deg + math.copysign(travel_deg, self.end_deg - self.start_deg)

    def halted(self, time_s: float) -> "Move":
        """Return the move as it is when it is broken off."""
        return replace(self, end_deg=self.angle_deg(time_s))

    def sensed_deg(self, times_s: FloatArray, tau_s: float) -> FloatArray:
        """Angle that an output with the time constant `tau_s` has come to; it was settled when the move began.

        A single angle instead of one for each of the rising `times_s` where all is settled to 1e-10 of the travel.
        """
        if times_s[0] - self.ended_s >= 25.0 * tau_s:
            return np.array([self.end_deg])
        angles_deg = np.array([self.angle_deg(time_s) for time_s in times_s.tolist()])
        return angles_deg - self._lag_deg(times_s, tau_s) if tau_s else angles_deg

    def _lag_deg(self, times_s: FloatArray, tau_s: float) -> FloatArray:
        """Solve `tau dlag/dt = tau v - lag`, v being the speed during the move and zero after it."""
        moved_s = np.maximum(times_s - self.started_s, 0.0)
        rested_s = np.maximum(times_s - self.ended_s, 0.0)
        full_deg = math.copysign(self.speed_deg_s * tau_s, self.end_deg - self.start_deg)
        return np.asarray(full_deg * (np.exp(-rested_s / tau_s) - np.exp(-moved_s / tau_s)))


class SimulatedHead:
    """A dividing head that turns at constant speed by a clock. Fits `tumble.drivers.protocols.Positioner`.

    Parameters
    ----------
    clock
        Clock by which it moves.
    options
        Limits, counts and speed.
    before_move
        Called before every move, so that the world can follow the path travelled until then.
    serial
        Number by which it is told from another.
    """

    def __init__(
        self, clock: Clock, options: HeadOptions, before_move: Callable[[], None], serial: str = "SIM-HEAD"
    ) -> None:
        self._clock = clock
        self._options = options
        self._before_move = before_move
        self._serial = serial
        self.move = self._move(0.0, 0.0)
        """What the head does now, or did last."""
        self.direction = 0
        """Sign of the last move, 0 before the first."""

    @property
    def limits_deg(self) -> tuple[float, float]:
        """Soft limits."""
        return self._options.limits_deg

    @property
    def speed_deg_s(self) -> float:
        """Speed of every move."""
        return self._options.speed_deg_s

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated head", serial=self._serial)

    def home(self) -> None:
        """Go to zero, wherever the limits are."""
        self._travel_to(0.0)

    def start_move(self, angle_deg: float) -> None:
        """Begin to move to the nearest count. Raises `LimitError` outside the limits, or for what is no angle."""
        check_limits(DEVICE, angle_deg, self.limits_deg)
        self._travel_to(self._options.on_the_grid(angle_deg))

    def status(self) -> PositionerStatus:
        """Angle in whole counts, and whether it moves."""
        now_s = self._clock.monotonic_s()
        angle_deg = self._options.on_the_grid(self.move.angle_deg(now_s))
        moving = self.move.ended_s - now_s > ROUNDING_S
        return PositionerStatus(angle_deg=angle_deg, moving=moving, device_time_s=now_s)

    def stop(self) -> None:
        """Halt where it is, at once."""
        self.move = self.move.halted(self._clock.monotonic_s())

    def _travel_to(self, angle_deg: float) -> None:
        self._before_move()
        here_deg = self.move.angle_deg(self._clock.monotonic_s())
        if angle_deg != here_deg:
            self.direction = 1 if angle_deg > here_deg else -1
        self.move = self._move(here_deg, angle_deg)

    def _move(self, start_deg: float, end_deg: float) -> Move:
        now_s = self._clock.monotonic_s()
        return Move(start_deg=start_deg, end_deg=end_deg, started_s=now_s, speed_deg_s=self.speed_deg_s)


class HeadErrors:
    """True minus reported angle, as far as it stays with the head."""

    def __init__(self, effects: Effects, external: HeadError | None) -> None:
        per_turn = [(1, effects.head_eccentricity), (2, effects.head_second_harmonic)]
        if effects.graduation:
            per_turn.append((effects.graduation.order, effects.graduation))
        self._harmonics = [(order, h.amplitude_deg, h.phase_deg) for order, h in per_turn if h]
        self._backlash_deg = effects.backlash
        self._external = external

    def error_deg(self, angle_deg: FloatArray, direction: int, time_s: FloatArray) -> FloatArray:
        """Error at reported angles after a move in `direction`: eccentricity, graduation, backlash and the like.

        Parameters
        ----------
        angle_deg
            Reported angles, shape (rows,) or (1,).
        direction
            Sign of the last move; 0 before the first, without backlash.
        time_s
            Seconds since the world began, shape (rows,).
        """
        total_deg: FloatArray = np.full_like(angle_deg, self._backlash_deg if direction < 0 else 0.0)
        for order, amplitude_deg, phase_deg in self._harmonics:
            total_deg += amplitude_deg * np.sin(np.deg2rad(order * angle_deg + phase_deg))
        if self._external is None:
            return total_deg
        rows = np.broadcast(angle_deg, time_s)
        external_deg = [float(self._external(float(angle), direction, float(time))) for angle, time in rows]
        return np.asarray(total_deg + np.array(external_deg))
