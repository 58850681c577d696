"""What samples the channels of the simulated platform."""

from collections.abc import Sequence
from typing import Final, Protocol

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import ChannelBlock, FloatArray, Identity
from tumble.drivers.simulated.samples import check_samples
from tumble.messages import Message

LEVELLING_RATE: Final = "levelling_rate_deg_h"
AZIMUTH_RATE: Final = "azimuth_rate_deg_h"
TILT_GAMMA: Final = "tilt_gamma_deg"
TILT_BETA: Final = "tilt_beta_deg"
CHANNELS: Final = (LEVELLING_RATE, AZIMUTH_RATE, TILT_GAMMA, TILT_BETA)
"""Rate with which the platform is kept level, rate about its azimuth axis, tilt of the levelling axis (positive where
it points down), and how far the platform is off level about it."""


class Channels(Protocol):
    """What the world offers to whoever samples it."""

    def sample(self, times_s: FloatArray, rate_hz: float) -> dict[str, FloatArray]:
        """Every channel with its noise at clock times; the first samples after a move begin a dwell."""
        ...

    def sensor_degc(self, time_s: float) -> float:
        """What the platform's thermometer says at a clock time."""
        ...


class PlatformOutputs:
    """Some or all channels. Fits `tumble.drivers.simulated.worlds.Meter`."""

    def __init__(self, clock: Clock, world: Channels, channels: Sequence[str]) -> None:
        self._clock, self._world, self._channels = clock, world, tuple(channels)

    def identify(self) -> Identity:
        """Say that it is simulated."""
        return Identity(model="tumble simulated gyro platform", serial="SIM-PLATFORM")

    def acquire(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Take samples of all channels from now on; the clock advances by `samples / rate_hz`.

        Raises `DeviceError` where there is nothing to take.
        """
        block = self.take(samples, rate_hz)
        self._clock.sleep(samples / rate_hz)
        return block

    def take(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Return at once what `acquire` returns when the samples are there. Raises `DeviceError`."""
        check_samples(Message("simulated gyro platform"), samples, rate_hz)
        started_s = self._clock.monotonic_s()
        times_s = started_s + np.arange(samples) / rate_hz
        sampled = self._world.sample(times_s, rate_hz)
        return ChannelBlock(
            channels={name: sampled[name] for name in self._channels},
            rate_hz=rate_hz,
            device_time_s=started_s,
            temperature_degc=self._world.sensor_degc(float(times_s[samples // 2])),
        )

    def temperatures_degc(self) -> dict[str, float]:
        """What the thermometer says now, for every channel; it is no look at the outputs."""
        return dict.fromkeys(self._channels, self._world.sensor_degc(self._clock.monotonic_s()))
