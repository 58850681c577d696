"""Whether the channels of an instrument have usable values, or have had none for long."""

import math
from collections.abc import Mapping
from typing import Final

import numpy as np

from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import FloatArray
from tumble.messages import Message

USELESS_S: Final = 30.0
"""Out of range for so long without a break, a channel is told in another unit than it should be, or is broken."""
OVERLOAD: Final = 9.9e37
"""From this magnitude on a sample is no value: the instrument says that it is out of range."""


class Watch:
    """Follows the channels of an instrument from block to block.

    Parameters
    ----------
    device
        What errors call the instrument.
    ranges
        Where values may be, by channel.
    """

    def __init__(self, device: str, ranges: Mapping[str, tuple[float, float]]) -> None:
        self._device, self._ranges = device, ranges
        self._useless_s: dict[str, float] = {}

    def forget(self) -> None:
        """Begin anew."""
        self._useless_s.clear()

    def see(self, channels: Mapping[str, FloatArray], rate_hz: float) -> None:
        """Look at a block. Raises `DeviceError` where a channel has had no usable value for `USELESS_S`."""
        for name, values in channels.items():
            useless = bool(np.all(np.isnan(values) | (np.abs(values) >= OVERLOAD)))
            useless_s = self._useless_s.get(name, 0.0) + len(values) / rate_hz
            self._useless_s[name] = useless_s if useless else 0.0
            if self._useless_s[name] >= USELESS_S:
                raise self._error(name)

    def _error(self, name: str) -> DeviceError:
        low, high = self._ranges.get(name, (-math.inf, math.inf))
        between = Message(" between {low:g} and {high:g}", low=low, high=high) if math.isfinite(high - low) else ""
        happened = Message(
            "{name} has had no value{between} for {useless_s:g} s",
            name=name,
            between=between,
            useless_s=self._useless_s[name],
        )
        return DeviceError(self._device, happened, Message("check its unit in the stand file, and whether it works"))
