"""Simulated voltmeters at the outputs of three accelerometers: one at all of them, or one at each."""

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import ChannelBlock, Identity
from tumble.drivers.simulated.daq import Converter
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.samples import check_samples
from tumble.messages import Message

PAUSE_S = 600.0
"""After this nothing remains of the previous reading."""


class OutputTerminals(Protocol):
    """What the world offers to a voltmeter."""

    @property
    def dwell(self) -> int:
        """Number of the dwell, from 1; 0 before the first."""
        ...

    def begin_acquisition(self) -> None:
        """Note that samples are about to be taken."""
        ...

    def sample_v(self, times_s: FloatArray, channel: int) -> FloatArray:
        """Voltage of an output, noise included, at clock times."""
        ...

    def sensor_degc(self, time_s: float, channel: int) -> float:
        """What the thermometer of an accelerometer says at a clock time."""
        ...


class OutputsMeter:
    """A voltmeter at some of the outputs. Fits `tumble.drivers.protocols.Sampler`.

    With the effect `settling` a part of what each channel read in the previous dwell remains in all that it reads in
    this one, unless more than `PAUSE_S` passed.
    """

    def __init__(
        self,
        clock: Clock,
        terminals: OutputTerminals,
        converter: Converter,
        *,
        channels: Mapping[str, int],
        settling: float,
    ) -> None:
        self._clock, self._terminals, self._converter = clock, terminals, converter
        self._channels = channels
        self._settling = settling
        self._dwell = 0
        self._last_s = -np.inf
        self._last_v: dict[str, float] = {}
        self._remainder_v: dict[str, float] = {}

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated DAQ", serial="SIM-DAQ")

    def acquire(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Take samples of all channels from now on; the clock advances by `samples / rate_hz`.

        Raises `DeviceError` where there is nothing to take.
        """
        block = self.take(samples, rate_hz)
        self._clock.sleep(samples / rate_hz)
        return block

    def take(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Return at once what `acquire` returns when the samples are there. Raises `DeviceError`."""
        check_samples(Message("simulated DAQ"), samples, rate_hz)
        started_s = self._clock.monotonic_s()
        times_s = started_s + np.arange(samples) / rate_hz
        self._begin(started_s)
        outputs_v = {name: self._with_remainder(name, times_s) for name in self._channels}
        self._last_v = {name: float(values_v.mean()) for name, values_v in outputs_v.items()}
        self._last_s = started_s + samples / rate_hz
        middle_s = float(times_s[samples // 2])
        degc = {name: self._terminals.sensor_degc(middle_s, number) for name, number in self._channels.items()}
        return ChannelBlock(
            channels={name: self._converter.shown_v(values_v) for name, values_v in outputs_v.items()},
            rate_hz=rate_hz,
            device_time_s=started_s,
            temperature_degc=sum(degc.values()) / len(degc),
            temperatures_degc=degc,
        )

    def temperatures_degc(self) -> dict[str, float]:
        """What the thermometers say now, by channel; it is no look at the outputs."""
        now_s = self._clock.monotonic_s()
        return {name: self._terminals.sensor_degc(now_s, number) for name, number in self._channels.items()}

    def _begin(self, now_s: float) -> None:
        self._terminals.begin_acquisition()
        if self._terminals.dwell != self._dwell:
            self._dwell = self._terminals.dwell
            self._remainder_v = dict(self._last_v) if now_s - self._last_s <= PAUSE_S else {}

    def _with_remainder(self, name: str, times_s: FloatArray) -> FloatArray:
        output_v = self._terminals.sample_v(times_s, self._channels[name])
        if name not in self._remainder_v:
            return output_v
        return output_v + self._settling * (self._remainder_v[name] - output_v)
