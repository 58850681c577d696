"""Readings: when they are taken, when they are there, and what is wrong with them."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.drivers.simulated.daq import OVERLOAD_V
from tumble.drivers.simulated.geometry import FloatArray
from tumble.emulators.faults import Faults
from tumble.emulators.scpi.language import ScpiError
from tumble.emulators.world import SharedWorld

OVERRANGE: Final = 1.2
"""A range measures up to so many times its name."""


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """What is to be measured once the trigger comes."""

    count: int
    interval_s: float
    """From one reading to the next, in s."""
    source: str
    """Trigger source: IMM, BUS, or another one that never comes."""
    temperature: bool
    """Temperature in °C instead of DC voltage in V."""
    limit_v: float
    """Beyond this range the reading is an overload, in V."""


class Triggering:
    """The trigger system and the reading memory (SCPI-1999, volume 2, chapter 24): idle, waiting or measuring.

    Readings are known as soon as the trigger comes, and given out when the clock of the world has got to the last.
    """

    def __init__(self, world: SharedWorld, faults: Faults) -> None:
        self._world = world
        self._faults = faults
        self._waiting: Measurement | None = None
        self._readings: FloatArray | None = None
        self._ready_s = 0.0

    @property
    def busy(self) -> bool:
        """Whether readings are being taken."""
        return self._readings is not None and self._world.clock.monotonic_s() < self._ready_s

    def initiate(self, measurement: Measurement) -> None:
        """Wait for the trigger, or measure at once where it is immediate. Raises `ScpiError` unless idle."""
        if self.busy or self._waiting:
            raise ScpiError(-213)
        self._readings = None
        if measurement.source in ("IMM", "TIM"):
            self._measure(measurement)
        else:
            self._waiting = measurement

    def trigger(self) -> None:
        """Take a trigger from the bus. Raises `ScpiError` where none is awaited."""
        if self._waiting is None or self._waiting.source != "BUS":
            raise ScpiError(-211)
        self._measure(self._waiting)

    def fetch(self) -> FloatArray:
        """All readings; they stay. Raises `ScpiError` where there are none and none will be."""
        if self._waiting:
            raise ScpiError(-214)
        if self._readings is None:
            raise ScpiError(-230)
        return self._readings

    def take_out(self, most: int) -> FloatArray:
        """The oldest readings that are there, so many at most; they do not stay."""
        held = self._readings if self._readings is not None and not self.busy else np.empty(0)
        self._readings = held[most:] if len(held) > most else None
        return held[:most]

    def abort(self) -> None:
        """Become idle; readings that were not complete are lost."""
        if self.busy:
            self._readings = None
        self._waiting = None

    def forget(self) -> None:
        """Become idle with an empty memory."""
        self._waiting = self._readings = None

    def _measure(self, measurement: Measurement) -> None:
        self._waiting = None
        block = self._world.daq.take(measurement.count, 1.0 / measurement.interval_s)
        if measurement.temperature:
            readings = np.full(measurement.count, block.temperature_degc)
        else:
            (voltage_v,) = block.channels.values()
            over = np.abs(voltage_v) > OVERRANGE * measurement.limit_v
            readings = np.where(over, np.copysign(OVERLOAD_V, voltage_v), voltage_v)
        self._spoil(readings)
        self._readings = readings
        self._ready_s = block.device_time_s + measurement.count * measurement.interval_s

    def _spoil(self, readings: FloatArray) -> None:
        """One reading in the middle is none, where a fault says so."""
        middle = len(readings) // 2
        if self._faults.take("nan"):
            readings[middle] = np.nan
        if self._faults.take("overload"):
            readings[middle] = OVERLOAD_V
