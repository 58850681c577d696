"""The head with the unit on it: how the unit really stands, and on what path it came there."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.simulated.geometry import FloatArray, ax_turning_points_deg, projections, seat
from tumble.drivers.simulated.head import HeadErrors, HeadOptions, SimulatedHead
from tumble.drivers.simulated.noise import Stream, standard_normal
from tumble.drivers.simulated.settings import Simulated
from tumble.drivers.simulated.unit import Hysteresis


@dataclass(kw_only=True)
class Counts:
    """How often each thing has happened. Every random draw is keyed by one of these."""

    acquisitions: int = 0
    in_dwell: int = 0
    """Acquisitions in the present dwell, or in the last one."""
    dwells: int = 0
    """Stays of the head at which something was acquired."""
    mountings: int = 1
    turn_ons: int = 1


class Bench:
    """Head, seat and unit, with every angle between the head's reading and the unit.

    The unit begins face-up with the head at zero. A dwell begins with the first acquisition after a move or a change of
    mount; all acquisitions until the next move belong to it.
    """

    def __init__(self, settings: Simulated, clock: Clock, options: HeadOptions, errors: HeadErrors) -> None:
        self._settings = settings
        self._effects = settings.effects
        self._alpha0_deg = settings.unit_parameters.alpha0_deg
        self._clock = clock
        self._errors = errors
        self._began_s = clock.monotonic_s()
        self._misread_deg = self._effects.misreading.by_row() if self._effects.misreading else {}
        self._in_dwell = False
        self.counts = Counts()
        self.mount = "face-up"
        """Mount in which the unit sits."""
        self._seated = seat(self.mount)
        self.head = SimulatedHead(clock, options, self._leave)
        self._followed_deg = self._true_now_deg()
        ax_g = self._ax_g(self._followed_deg)
        reach_g = settings.hysteresis_reach_g
        self._hysteresis = Hysteresis(half_gap_v=self._effects.hysteresis, reach_g=reach_g, ax_g=ax_g)

    @property
    def hysteresis_v(self) -> float:
        """Offset that the way to the present attitude has left in the unit, in V."""
        return self._hysteresis.offset_v

    def seat(self, mount: str) -> None:
        """Seat the unit in another mount, by hand; where it already sits so, it is left alone.

        Raises `ValueError` for a mount that does not exist.
        """
        seated = seat(mount)
        if mount == self.mount:
            return
        self._leave()
        self.mount, self._seated = mount, seated
        self.counts.mountings += 1
        self._follow()

    def postpone(self, outage_s: float) -> None:
        """Count time as if the world had begun so much later."""
        self._began_s += outage_s

    def begin_acquisition(self) -> None:
        """Note that samples are about to be taken: the first ones after a move begin a dwell."""
        self.counts.acquisitions += 1
        if not self._in_dwell:
            self._in_dwell = True
            self.counts.dwells += 1
            self.counts.in_dwell = 0
        self.counts.in_dwell += 1
        self._follow()

    def gravity_g(self, times_s: FloatArray) -> FloatArray:
        """Projections of gravity that the unit feels at rising clock times, shape (rows, 3) or (1, 3)."""
        sensed_deg = self.head.move.sensed_deg(times_s - self._effects.latency, self._settings.response_tau_s)
        return self._projections(self._true_deg(sensed_deg, times_s))

    def static_gravity_g(self, mounts: Sequence[str], angles_deg: FloatArray) -> FloatArray:
        """Projections of gravity at reported angles approached in + direction, at time zero, in a perfect seat."""
        errors_deg = self._errors.error_deg(angles_deg, 1, np.zeros_like(angles_deg))
        true_deg = angles_deg + errors_deg + self._alpha0_deg
        gravity_g = np.empty((len(angles_deg), 3))
        names = np.asarray(mounts)
        for mount in set(mounts):
            rows = names == mount
            gravity_g[rows] = projections(seat(mount), true_deg[rows], self._effects.axis_tilt)
        return gravity_g

    def _true_deg(self, reported_deg: FloatArray, times_s: FloatArray) -> FloatArray:
        since_s = times_s - self._began_s
        misread_deg = self._misread_deg.get(self.counts.dwells, 0.0) if self._in_dwell else 0.0
        constant_deg = self._alpha0_deg + self._seating_deg() + misread_deg
        errors_deg = self._errors.error_deg(reported_deg, self.head.direction, since_s)
        true_deg = reported_deg + errors_deg + constant_deg
        if self._effects.base_tilt_drift:
            true_deg = true_deg + self._effects.base_tilt_drift * since_s / 3600.0
        return np.asarray(true_deg)

    def _seating_deg(self) -> float:
        drawn = standard_normal(self._settings.seed, Stream.SEATING, self.counts.mountings)
        return self._effects.seating * drawn

    def _projections(self, true_deg: FloatArray) -> FloatArray:
        return projections(self._seated, true_deg, self._effects.axis_tilt)

    def _ax_g(self, true_deg: float) -> float:
        return float(self._projections(np.array([true_deg]))[0, 0])

    def _true_now_deg(self) -> float:
        now_s = self._clock.monotonic_s()
        return float(self._true_deg(np.array([self.head.move.angle_deg(now_s)]), np.array([now_s]))[0])

    def _leave(self) -> None:
        self._follow()
        self._in_dwell = False

    def _follow(self) -> None:
        """Take the unit's memory along the path to where it stands now, past every extremum of ax."""
        if not self._effects.hysteresis:
            return
        here_deg = self._true_now_deg()
        turning_deg = ax_turning_points_deg(self._seated, self._followed_deg, here_deg)
        for angle_deg in (*turning_deg.tolist(), here_deg):
            self._hysteresis.follow(self._ax_g(angle_deg))
        self._followed_deg = here_deg
