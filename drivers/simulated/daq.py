"""The simulated voltmeter with its thermometer."""

from typing import Protocol

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import VOLTAGE, Identity, SampleBlock
from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.samples import check_samples
from tumble.messages import Message

OVERLOAD_V = 9.9e37
"""How SCPI instruments write infinity (SCPI-1999, volume 1, 7.2.1.5)."""

PAUSE_S = 120.0
"""Longer than any move between two dwells: after this nothing remains of the previous reading."""


class Converter:
    """From a voltage at the terminals to the number that the instrument shows."""

    def __init__(self, effects: Effects, *, resolution_v: float, range_v: float) -> None:
        self._nonlinearity = effects.daq_nonlinearity
        self._range_step = effects.range_step
        self._resolution_v = resolution_v
        self._range_v = range_v

    def distorted_v(self, voltage_v: FloatArray) -> FloatArray:
        """Reading with the converter's nonlinearity and range step, before it is rounded."""
        reading_v = voltage_v
        if self._nonlinearity:
            phase_rad = 2.0 * np.pi * voltage_v / self._nonlinearity.period_v
            reading_v = reading_v + self._nonlinearity.amplitude * np.sin(phase_rad)
        if self._range_step:
            reading_v = reading_v + self._range_step.step * (voltage_v > self._range_step.threshold_v)
        return reading_v

    def shown_v(self, voltage_v: FloatArray) -> FloatArray:
        """Reading as shown: distorted, in whole steps, 9.9e37 where the voltage is out of range."""
        reading_v = self.distorted_v(voltage_v)
        if self._resolution_v:
            reading_v = np.round(reading_v / self._resolution_v) * self._resolution_v
        return np.where(np.abs(voltage_v) > self._range_v, OVERLOAD_V, reading_v)


class Terminals(Protocol):
    """What the world offers to a DAQ that is wired to it."""

    def begin_acquisition(self) -> None:
        """Note that samples are about to be taken."""
        ...

    @property
    def dwell(self) -> int:
        """Number of the dwell, from 1."""
        ...

    @property
    def mounting(self) -> int:
        """Number of the mounting, from 1."""
        ...

    def sample_v(self, times_s: FloatArray) -> FloatArray:
        """Voltage, noise included, at clock times."""
        ...

    def sensor_degc(self, time_s: float) -> float:
        """What the thermometer says at a clock time."""
        ...


class SimulatedDaq:
    """A voltmeter at the terminals of the simulated unit. Fits `tumble.drivers.protocols.Sampler`.

    With the effect `settling` a part of what was read in the previous dwell remains in all that is read in this one:
    `v + fraction (previous - v)`, unless the unit was seated anew or more than `PAUSE_S` passed.
    """

    def __init__(self, clock: Clock, terminals: Terminals, converter: Converter, *, settling: float) -> None:
        self._clock = clock
        self._terminals = terminals
        self._converter = converter
        self._settling = settling
        self._dwell = self._mounting = 0
        self._last_v, self._last_s = 0.0, -np.inf
        self._remainder_v: float | None = None

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated DAQ", serial="SIM-DAQ")

    def acquire(self, samples: int, rate_hz: float) -> SampleBlock:
        """Take samples from now on; the clock advances by `samples / rate_hz`.

        Raises `DeviceError` where there is nothing to take.
        """
        block = self.take(samples, rate_hz)
        self._clock.sleep(samples / rate_hz)
        return block

    def take(self, samples: int, rate_hz: float) -> SampleBlock:
        """Return at once what `acquire` returns when the samples are there, for a caller that does the waiting.

        Raises `DeviceError` where there is nothing to take.
        """
        check_samples(Message("simulated DAQ"), samples, rate_hz)
        started_s = self._clock.monotonic_s()
        times_s = started_s + np.arange(samples) / rate_hz
        self._terminals.begin_acquisition()
        voltage_v = self._with_remainder(self._terminals.sample_v(times_s), started_s)
        temperature_degc = self._terminals.sensor_degc(float(times_s[samples // 2]))
        self._last_v, self._last_s = float(voltage_v.mean()), started_s + samples / rate_hz
        return SampleBlock(
            voltage_v=self._converter.shown_v(voltage_v),
            rate_hz=rate_hz,
            device_time_s=started_s,
            temperature_degc=temperature_degc,
        )

    def temperatures_degc(self) -> dict[str, float]:
        """What the thermometer says now; it is no look at the output."""
        return {VOLTAGE: self._terminals.sensor_degc(self._clock.monotonic_s())}

    def _with_remainder(self, voltage_v: FloatArray, now_s: float) -> FloatArray:
        if self._terminals.dwell != self._dwell:
            directly = self._terminals.mounting == self._mounting and now_s - self._last_s <= PAUSE_S
            self._remainder_v = self._last_v if directly else None
            self._dwell, self._mounting = self._terminals.dwell, self._terminals.mounting
        if self._remainder_v is None:
            return voltage_v
        return voltage_v + self._settling * (self._remainder_v - voltage_v)
