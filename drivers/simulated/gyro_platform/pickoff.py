"""The turntable's pickoff: by how much the truth differs from what it reports."""

from typing import Final

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.gyro_platform.effects import PlatformEffects


class Pickoff:
    """True angles of reported ones."""

    def __init__(self, effects: PlatformEffects) -> None:
        waves = [(1, effects.pickoff_eccentricity), (2, effects.pickoff_second_harmonic)]
        if effects.pickoff_graduation:
            waves.append((effects.pickoff_graduation.order, effects.pickoff_graduation))
        self._waves: Final = [(order, each.amplitude_deg, each.phase_deg) for order, each in waves]
        self._scale, self._backlash_deg = effects.pickoff_scale, effects.backlash

    def true_rad(self, reported_deg: FloatArray, direction: int) -> FloatArray:
        """True angles, in radians, where these are reported after a move in `direction`."""
        true_deg = reported_deg * (1.0 + self._scale) + (self._backlash_deg if direction < 0 else 0.0)
        for order, amplitude_deg, phase_deg in self._waves:
            true_deg = true_deg + amplitude_deg * np.sin(np.deg2rad(order * reported_deg + phase_deg))
        return np.asarray(np.deg2rad(true_deg))
