"""The simulated temperature chamber: air that follows a set point, and a unit that follows the air."""

from collections.abc import Callable
from typing import Final

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.errors import LimitError
from tumble.drivers.protocols import EnvironmentStatus, Identity
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.tables import ChamberTable
from tumble.messages import Message

STEP_S: Final = 1.0
"""Temperatures go in steps of this, exact for each, and straight between."""
AIR_TAU_S: Final = 60.0
"""Time constant with which the air takes on the set point."""


class SimulatedChamber:
    """Fits `tumble.drivers.protocols.Environment`.

    Parameters
    ----------
    clock
        By which it lives.
    room_degc
        Temperature of the room at seconds since the world began.
    unit_tau_s
        Time constant with which the unit takes on the temperature of the air.
    """

    def __init__(self, clock: Clock, room_degc: Callable[[FloatArray], FloatArray], *, unit_tau_s: float) -> None:
        self._clock, self._room_degc, self._unit_tau_s = clock, room_degc, unit_tau_s
        self._began_s = clock.monotonic_s()
        self.options = ChamberTable(driver="simulated", limits_degC=(-70.0, 180.0))
        self.setpoint_degc = 23.0
        self.running = False
        self.door_open = False
        self.door_locked = False
        self.alarm = False
        self.stuck = False
        """Whether the air stays as it is, whatever it is told."""
        self._ran = False
        here_degc = float(room_degc(np.zeros(1))[0])
        self._air_degc, self._unit_degc = [here_degc], [here_degc]

    @property
    def limits_degc(self) -> tuple[float, float]:
        """Set points that may be asked for."""
        return self.options.limits_degc

    @property
    def ramp_k_per_min(self) -> float | None:
        """As the stand file says."""
        return self.options.ramp_k_per_min

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated chamber", serial="SIM-CHAMBER")

    def begin(self, setpoint_degc: float) -> None:
        """Run towards a set point. Raises `LimitError` outside the limits."""
        low_degc, high_degc = self.limits_degc
        if not low_degc <= setpoint_degc <= high_degc:
            raise LimitError(
                Message("temperature chamber"),
                Message(
                    "{setpoint:g} °C is outside {low:g} to {high:g} °C",
                    setpoint=setpoint_degc,
                    low=low_degc,
                    high=high_degc,
                ),
                Message("change the temperatures, or limits_degC of the stand"),
            )
        self.set(setpoint_degc, running=True)

    def set(self, setpoint_degc: float, *, running: bool) -> None:
        """Be told what to do from now on."""
        self._follow()
        self.setpoint_degc, self.running = setpoint_degc, running
        self._ran = self._ran or running

    def status(self) -> EnvironmentStatus:
        """Temperature of the air, set point and door."""
        return EnvironmentStatus(
            temperature_degc=self.air_degc(),
            setpoint_degc=self.setpoint_degc,
            door_open=self.door_open,
            alarm=self.alarm,
            running=self.running,
        )

    def lock_door(self, locked: bool) -> None:
        """Keep the door shut, or let it be opened."""
        self.door_locked = locked

    def make_safe(self) -> None:
        """Go to the safe set point, or stop."""
        safe_degc = self.options.safe_degc
        self.set(self.setpoint_degc if safe_degc is None else safe_degc, running=safe_degc is not None)

    def air_degc(self) -> float:
        """Temperature of the air now."""
        return float(self._at(self._air_degc, np.array([self._clock.monotonic_s()]))[0])

    def unit_degc(self, times_s: FloatArray) -> FloatArray:
        """Temperature of the unit at rising clock times, which are not far from now."""
        if not self._ran:
            return self._room_degc(times_s - self._began_s)
        return self._at(self._unit_degc, times_s)

    def postpone(self, outage_s: float) -> None:
        """Count time as if the world had begun so much later."""
        self._began_s += outage_s

    def _at(self, values_degc: list[float], times_s: FloatArray) -> FloatArray:
        steps = np.maximum(times_s - self._began_s, 0.0) / STEP_S
        first, last = int(steps[0]), int(steps[-1]) + 2
        self._extend(last)
        return np.interp(steps, np.arange(first, last), values_degc[first:last])

    def _follow(self) -> None:
        """Let what was told until now have its effect, and nothing beyond."""
        steps = int((self._clock.monotonic_s() - self._began_s) // STEP_S) + 1
        self._extend(steps)
        del self._air_degc[steps:], self._unit_degc[steps:]

    def _extend(self, steps: int) -> None:
        missing = steps - len(self._air_degc)
        if missing <= 0:
            return
        times_s = STEP_S * np.arange(len(self._air_degc), steps, dtype=np.float64)
        towards_air, towards_unit = (1.0 - np.exp(-STEP_S / tau_s) for tau_s in (AIR_TAU_S, self._unit_tau_s))
        air_degc, unit_degc = self._air_degc[-1], self._unit_degc[-1]
        for room_degc in self._room_degc(times_s).tolist():
            if self._ran:
                aim_degc = air_degc if self.stuck else self.setpoint_degc if self.running else room_degc
                air_degc += towards_air * (aim_degc - air_degc)
                unit_degc += towards_unit * (air_degc - unit_degc)
            else:
                air_degc = unit_degc = room_degc
            self._air_degc.append(air_degc)
            self._unit_degc.append(unit_degc)
