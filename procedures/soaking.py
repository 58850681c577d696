"""Bringing the unit to a temperature: the set point goes there, and the soak is over once nothing moves any more.

It is over when over a whole window the chamber stood within a tolerance of the set point, its temperature and those of
the unit's own thermometers changed by less than a rate, and, where that is asked for, no output by more than a slope;
what noise explains is left aside.
"""

import math
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Environment, EnvironmentStatus
from tumble.messages import Message
from tumble.procedures.interlock import check_environment


@dataclass(frozen=True, kw_only=True)
class Seen:
    """What the samplers see of the unit at one moment."""

    outputs_v: Mapping[str, float] = field(default_factory=dict)
    """Means of short blocks, by channel."""
    temperatures_degc: Mapping[str, float] = field(default_factory=dict)
    """Of the unit, by thermometer."""


_NOISES: Final = 2.0
"""A slope is taken for noise up to so many standard errors."""
_FEWEST: Final = 4
"""Looks in a window."""


@dataclass(frozen=True, kw_only=True)
class Soak:
    """When a unit has taken on a temperature."""

    window_s: float = 600.0
    """Over which everything must hold."""
    tolerance_k: float = 0.5
    """How far the chamber may be from the set point."""
    rate_k_per_h: float = 1.0
    """The most by which its temperature, and that of the unit, may change."""
    slope_v_per_h: float | None = None
    """The most by which an output may change; None where the outputs are not asked."""
    look_s: float = 30.0
    """From one look to the next."""
    timeout_s: float = 14_400.0
    """After so long it is given up."""


@dataclass(frozen=True)
class _Look:
    time_s: float
    temperature_degc: float
    seen: Seen


@dataclass
class Soaking:
    """One soak of a unit in an environment.

    Parameters
    ----------
    environment
        The chamber.
    title
        What sentences call it.
    clock
        The stand's clock.
    soak
        When it is over.
    unit
        What is seen of the unit; asked at every look.
    check
        Called between looks; raises where the run should end.
    """

    environment: Environment
    title: str
    clock: Clock
    soak: Soak
    unit: Callable[[], Seen]
    check: Callable[[], object]
    _looks: deque[_Look] = field(default_factory=deque)

    def carry_out(self, setpoint_degc: float) -> str:
        """Go to a set point and stay until the soak is over; returns what it came to, in words.

        Raises
        ------
        DeviceError
            It does not come to rest in time, its door is open, it complains, or it fails.
        """
        began_s = self.clock.monotonic_s()
        told_degc = self._begin(setpoint_degc)
        while True:
            status = self.environment.status()
            check_environment(self.title, status)
            told_degc = self._ramped(told_degc, setpoint_degc)
            if not status.running:  # it had lost its power
                self.environment.begin(told_degc)
            self._note(status)
            lasted_s = self.clock.monotonic_s() - began_s
            if told_degc == setpoint_degc and self._over(setpoint_degc):
                return Message(
                    "{degc:.2f} °C after {minutes:.0f} min", degc=status.temperature_degc, minutes=lasted_s / 60.0
                )
            if lasted_s > self.soak.timeout_s:
                raise self._given_up(setpoint_degc, status, lasted_s)
            self._wait()

    def _begin(self, setpoint_degc: float) -> float:
        """Begin where the air is, where there is a ramp; returns the set point that was told."""
        first_degc = setpoint_degc
        if self.environment.ramp_k_per_min is not None:
            first_degc = self._towards(self.environment.status().temperature_degc, setpoint_degc)
        self.environment.begin(first_degc)
        return first_degc

    def _ramped(self, told_degc: float, setpoint_degc: float) -> float:
        """Tell the next set point of the ramp, where it is not at its end."""
        if told_degc == setpoint_degc:
            return told_degc
        next_degc = self._towards(told_degc, setpoint_degc)
        self.environment.begin(next_degc)
        return next_degc

    def _towards(self, from_degc: float, setpoint_degc: float) -> float:
        """The set point one look later, as steep as may be."""
        ramp = self.environment.ramp_k_per_min
        assert ramp is not None, "asked where there is one"
        step_k = ramp * self.soak.look_s / 60.0
        away_k = setpoint_degc - from_degc
        low_degc, high_degc = self.environment.limits_degc
        within_degc = min(max(from_degc, low_degc), high_degc)
        return setpoint_degc if abs(away_k) <= step_k else within_degc + math.copysign(step_k, away_k)

    def _note(self, status: EnvironmentStatus) -> None:
        seen, now_s = self.unit(), self.clock.monotonic_s()
        self._looks.append(_Look(now_s, status.temperature_degc, seen))
        while len(self._looks) > 1 and now_s - self._looks[1].time_s >= self.soak.window_s:
            self._looks.popleft()

    def _over(self, setpoint_degc: float) -> bool:
        looks = list(self._looks)
        if len(looks) < _FEWEST or looks[-1].time_s - looks[0].time_s < self.soak.window_s:
            return False
        temperatures_degc = [look.temperature_degc for look in looks]
        if max(abs(each - setpoint_degc) for each in temperatures_degc) > self.soak.tolerance_k:
            return False
        times_h = [look.time_s / 3600.0 for look in looks]
        rates = [temperatures_degc, *_series([look.seen.temperatures_degc for look in looks])]
        slopes = _series([look.seen.outputs_v for look in looks])
        limit = self.soak.slope_v_per_h
        return all(still(times_h, each, self.soak.rate_k_per_h) for each in rates) and (
            limit is None or all(still(times_h, each, limit) for each in slopes)
        )

    def _given_up(self, setpoint_degc: float, status: EnvironmentStatus, lasted_s: float) -> DeviceError:
        return DeviceError(
            self.title,
            Message(
                "has not come to rest at {setpoint:g} °C in {minutes:.0f} min; its air has {degc:.2f} °C",
                setpoint=setpoint_degc,
                minutes=lasted_s / 60.0,
                degc=status.temperature_degc,
            ),
            Message("look at it, or allow more under [soak] of the programme; then resume the run"),
        )

    def _wait(self) -> None:
        """Wait for the next look, in short waits in which the run can be stopped."""
        until_s = self.clock.monotonic_s() + self.soak.look_s
        while (left_s := until_s - self.clock.monotonic_s()) > 0.0:
            self.check()
            self.clock.sleep(min(left_s, 1.0))


def _series(looks: list[Mapping[str, float]]) -> list[list[float]]:
    """The values of each name in the last look, one after the other."""
    return [[look[name] for look in looks] for name in looks[-1]]


def still(times_h: list[float], values: list[float], limit_per_h: float) -> bool:
    """Whether values change by no more than a limit an hour, as far as their scatter about a line tells."""
    times = np.array(times_h) - np.mean(times_h)
    spread = float(times @ times)
    slope = float(times @ np.array(values)) / spread
    left = np.array(values) - np.mean(values) - slope * times
    noise = math.sqrt(float(left @ left) / max(len(values) - 2, 1) / spread)
    return abs(slope) <= limit_per_h + _NOISES * noise
