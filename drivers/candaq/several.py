"""A DAQ on CAN that sends several channels by itself, whose samples are taken at the same time."""

from collections.abc import Mapping

import numpy as np

from tumble.drivers.candaq.frames import OVERLOAD_V
from tumble.drivers.candaq.free import FreeRunningDaq, twice_in_a_row
from tumble.drivers.candaq.inbox import DEVICE
from tumble.drivers.protocols import ChannelBlock, FloatArray, Identity
from tumble.drivers.usable import Watch


class SeveralChannels:
    """Fits `Sampler`, `Reconnectable` and `Remarking`; every channel is a free-running DAQ of one channel.

    Parameters
    ----------
    channels
        By name; all on the same bus.
    ranges
        Where the values of some of them may be; what is beyond is an overload, and for long a wrong unit.
    """

    def __init__(
        self, channels: Mapping[str, FreeRunningDaq], ranges: Mapping[str, tuple[float, float]] | None = None
    ) -> None:
        self._channels, self._ranges = channels, ranges or {}
        self._watch = Watch(DEVICE, self._ranges)
        self._first = next(iter(channels.values()))

    def identify(self) -> Identity:
        """What the DBC file lets it say of itself; every channel must come. Raises `NoReplyError`."""
        self._watch.forget()
        return [channel.identify() for channel in self._channels.values()][0]  # noqa: RUF015  # all of them are asked

    def reconnect(self) -> None:
        """Open the bus anew. Raises `LinkLostError` while nobody sends there."""
        for channel in self._channels.values():
            channel.reconnect()

    def remarks(self) -> tuple[str, ...]:
        """What was dropped or tried again on the bus, which all share."""
        return self._first.remarks()

    def last_remarks(self) -> tuple[str, ...]:
        """What of that has not been told."""
        return self._first.last_remarks()

    def acquire(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Take the next samples of all channels; where frames are lost or doubled, once more. Raises `DeviceError`."""
        complaint = ""
        for _ in range(2):
            block, complaint = self._block(samples, rate_hz)
            if not complaint:
                self._watch.see({name: block.channels[name] for name in self._ranges}, rate_hz)
                return block
        raise twice_in_a_row(complaint)

    def _block(self, samples: int, rate_hz: float) -> tuple[ChannelBlock, str]:
        for channel in self._channels.values():
            channel.begin()
        collected = {
            name: channel.collected(samples, rate_hz, dated=channel is self._first)
            for name, channel in self._channels.items()
        }
        blocks = {name: block for name, (block, _) in collected.items()}
        own_degc = {name: each.temperature_degc for name, each in blocks.items()}
        known_degc = {name: degc for name, degc in own_degc.items() if degc is not None}
        first = next(iter(blocks.values()))
        block = ChannelBlock(
            channels={name: self._in_range(name, each.voltage_v) for name, each in blocks.items()},
            rate_hz=rate_hz,
            device_time_s=first.device_time_s,
            temperature_degc=sum(known_degc.values()) / len(known_degc) if known_degc else None,
            temperatures_degc=known_degc,
        )
        return block, next((complaint for _, complaint in collected.values() if complaint), "")

    def _in_range(self, name: str, values: FloatArray) -> FloatArray:
        """Values with 9.9e37 for those that are out of range."""
        if name not in self._ranges:
            return values
        low, high = self._ranges[name]
        return np.where((values < low) | (values > high), OVERLOAD_V, values)
