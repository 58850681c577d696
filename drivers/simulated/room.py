"""The temperature of the room and of the unit in it."""

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.noise import Stream, Wander, generator
from tumble.drivers.simulated.settings import Temperature

WANDER_BAND_HZ = (1.0 / 21600.0, 1.0 / 600.0)
"""A room wanders over ten minutes to six hours."""


class Room:
    """Temperature as a function of time: a start, a steady ramp and a slow smooth wandering."""

    def __init__(self, settings: Temperature, seed: int) -> None:
        self._start_degc = settings.start_degc
        self._ramp_k_per_s = settings.ramp_k_per_h / 3600.0
        random = generator(seed, Stream.ROOM)
        self._wander = Wander(random, rms=settings.wander_k, band_hz=WANDER_BAND_HZ)

    def temperature_degc(self, time_s: FloatArray) -> FloatArray:
        """Temperature at seconds since the world began."""
        return np.asarray(self._start_degc + self._ramp_k_per_s * time_s + self._wander.at(time_s))
