"""A simulated voltmeter at output and references, which are sampled together."""

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import ChannelBlock, Identity
from tumble.drivers.simulated.daq import Converter
from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.samples import check_samples
from tumble.drivers.simulated.vibration.settings import SimulatedVibration
from tumble.messages import Message


class Terminals(Protocol):
    """What the world offers to a voltmeter."""

    @property
    def clock(self) -> Clock:
        """By which it lives."""
        ...

    def begin_acquisition(self) -> None:
        """Note that samples are about to be taken."""
        ...

    def sampled_v(self, clock_s: FloatArray) -> FloatArray:
        """Output and references, shape (rows, 4), at clock times."""
        ...

    def sensor_degc(self, clock_s: float) -> float:
        """What the thermometer of the unit says at a clock time."""
        ...


class VibrationMeter:
    """Fits `tumble.drivers.protocols.Sampler`; `channels` are places among output and references, by name."""

    def __init__(self, terminals: Terminals, settings: SimulatedVibration, channels: Mapping[str, int]) -> None:
        self._terminals, self._channels = terminals, channels
        self._converter = Converter(Effects(), resolution_v=settings.resolution_v, range_v=settings.range_v)

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated DAQ", serial="SIM-DAQ")

    def acquire(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Take samples of all channels from now on; the clock advances by `samples / rate_hz`.

        Raises `DeviceError` where there is nothing to take.
        """
        block = self.take(samples, rate_hz)
        self._terminals.clock.sleep(samples / rate_hz)
        return block

    def take(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Return at once what `acquire` returns when the samples are there. Raises `DeviceError`."""
        check_samples(Message("simulated DAQ"), samples, rate_hz)
        started_s = self._terminals.clock.monotonic_s()
        self._terminals.begin_acquisition()
        sampled_v = self._terminals.sampled_v(started_s + np.arange(samples) / rate_hz)
        return ChannelBlock(
            channels={name: self._converter.shown_v(sampled_v[:, place]) for name, place in self._channels.items()},
            rate_hz=rate_hz,
            device_time_s=started_s,
            temperature_degc=self._terminals.sensor_degc(started_s),
        )

    def temperatures_degc(self) -> dict[str, float]:
        """What the thermometer says now; it is no look at the outputs."""
        degc = self._terminals.sensor_degc(self._terminals.clock.monotonic_s())
        return dict.fromkeys(self._channels, degc)
