"""The levelling loop: a first-order lag between what would hold the platform level and what does.

With the correction rate S = -m1 β and β' = -(S + what turns the platform off its level), S follows
`f = rate along the levelling axis + drift + b'`, b being the angle at which the platform is level on the turntable:
`τ S' + S = f`, τ = 1/m1. On a leaning base b changes while the turntable turns. At rest f is constant, and what S lags
behind dies away as exp(-t/τ); drift is slow beside τ and is followed at once.
"""

from collections.abc import Callable
from typing import Final

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.head import Move

RAD_S_IN_DEG_H: Final = np.rad2deg(1.0) * 3600.0
_STEPS_PER_TAU: Final = 40
_MOST_STEPS: Final = 20_000

Followed = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Rate along the levelling axis in °/h and level angle b in radians, at reported angles in deg."""


class LevellingLag:
    """By how much S differs from what it is at rest, in °/h."""

    def __init__(self, tau_s: float, followed: Followed) -> None:
        self._tau_s, self._followed = tau_s, followed
        self._since_s, self._lag_deg_h = 0.0, 0.0

    def kick(self, time_s: float, rate_deg_h: float, turned_rad: float) -> None:
        """Note that the base was leaned otherwise: what S must follow has jumped by so much, and so has b."""
        lag_deg_h = self.at(np.array([time_s]))[0]
        self._lag_deg_h = lag_deg_h - rate_deg_h + turned_rad / self._tau_s * RAD_S_IN_DEG_H
        self._since_s = time_s

    def follow(self, move: Move, until_s: float) -> None:
        """Go along with a move, and with the rest after it, until a clock time."""
        end_s = min(until_s, move.ended_s)
        if end_s > max(self._since_s, move.started_s):
            self._through(move, max(self._since_s, move.started_s), end_s)
        self._lag_deg_h = float(self.at(np.array([until_s]))[0])
        self._since_s = until_s

    def at(self, times_s: FloatArray) -> FloatArray:
        """The lag at clock times after everything that was followed, if nothing has moved since."""
        return np.asarray(self._lag_deg_h * np.exp(-np.maximum(times_s - self._since_s, 0.0) / self._tau_s))

    def _through(self, move: Move, start_s: float, end_s: float) -> None:
        self._lag_deg_h = float(self.at(np.array([start_s]))[0])
        steps = int(np.clip(np.ceil((end_s - start_s) / self._tau_s * _STEPS_PER_TAU), 200, _MOST_STEPS))
        times_s = np.linspace(start_s, end_s, steps + 1)
        signed = np.sign(move.end_deg - move.start_deg) * move.speed_deg_s
        rate_deg_h, level_rad = self._followed(move.start_deg + signed * (times_s - move.started_s))
        step_s = (end_s - start_s) / steps
        pushed = np.diff(level_rad) / step_s * RAD_S_IN_DEG_H - self._tau_s * np.diff(rate_deg_h) / step_s
        left = np.exp(-(end_s - times_s[1:]) / self._tau_s)
        grown = float(np.sum(pushed * left)) * -np.expm1(-step_s / self._tau_s)
        self._lag_deg_h = self._lag_deg_h * float(np.exp(-(end_s - start_s) / self._tau_s)) + grown
        self._since_s = end_s
