"""Sweeps of an emulated scanner over its channels."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tumble.drivers.simulated.daq import OVERLOAD_V
from tumble.emulators.faults import Faults
from tumble.emulators.scpi.language import ScpiError
from tumble.emulators.scpi.triggering import OVERRANGE, Triggering
from tumble.emulators.world import SharedWorld


@dataclass(frozen=True)
class Sweep:
    """What is swept, and how."""

    count: int
    interval_s: float
    functions: Mapping[int, str]
    """`VOLT` or `TEMP`, by channel."""
    limits_v: Mapping[int, float]
    """Range, by channel."""


class Sweeping(Triggering):
    """The trigger system and the reading memory of a scanner; see `Triggering`."""

    def __init__(
        self, world: SharedWorld, faults: Faults, outputs: Mapping[int, str], thermometers: Mapping[int, str]
    ) -> None:
        super().__init__(world, faults)
        self._outputs, self._thermometers = outputs, thermometers
        self.scan: tuple[int, ...] = ()
        """Channels in the order in which they are read."""

    def sweep(self, wanted: Sweep) -> None:
        """Sweep over the scan list. Raises `ScpiError` unless idle, or where nothing is to be scanned."""
        if self.busy:
            raise ScpiError(-213)
        if not self.scan:
            raise ScpiError(-221)
        began_s = self._world.clock.monotonic_s()
        columns = dict(zip(self.scan, self._columns(wanted), strict=True))
        readings = np.column_stack([columns[channel] for channel in self.scan]).ravel()
        self._spoil(readings)
        self._readings = readings
        self._ready_s = began_s + wanted.count * wanted.interval_s

    def _columns(self, wanted: Sweep) -> "list[np.ndarray[tuple[int, ...], np.dtype[np.float64]]]":
        """The readings of each channel."""
        voltages = [channel for channel in self.scan if wanted.functions.get(channel) != "TEMP"]
        block = self._world.daq.take(wanted.count, 1.0 / wanted.interval_s).channels if voltages else {}
        columns = []
        for channel in self.scan:
            if channel in voltages:
                values_v = block[self._outputs[channel]]
                over = np.abs(values_v) > OVERRANGE * wanted.limits_v[channel]
                columns.append(np.where(over, np.copysign(OVERLOAD_V, values_v), values_v))
            else:
                degc = self._world.daq.temperatures_degc()[self._thermometers[channel]]
                columns.append(np.full(wanted.count, degc))
        return columns
