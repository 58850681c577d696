"""One axis of the stand: the simulated head that turns it, and by how much the truth differs from what it reports."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.head import HeadOptions, SimulatedHead
from tumble.drivers.simulated.two_axes.effects import TwoAxesEffects, Wave
from tumble.drivers.simulated.two_axes.geometry import RAD_PER_ARCSEC


def wave_rad(wave: Wave, order: int, angle_rad: FloatArray) -> FloatArray:
    """`A sin(n φ + p)`, in radians."""
    phase_rad = np.deg2rad(wave.phase_deg)
    return np.asarray(RAD_PER_ARCSEC * wave.amplitude_arcsec * np.sin(order * angle_rad + phase_rad))


@dataclass(frozen=True, kw_only=True)
class AxisErrors:
    """True minus reported angle."""

    eccentricity: Wave
    second_harmonic: Wave
    backlash_arcsec: float

    @classmethod
    def of(cls, name: str, effects: TwoAxesEffects) -> "AxisErrors":
        """Those of the axis `outer` or `inner`."""
        return cls(
            eccentricity=getattr(effects, f"{name}_eccentricity"),
            second_harmonic=getattr(effects, f"{name}_second_harmonic"),
            backlash_arcsec=getattr(effects, f"{name}_backlash").value_arcsec,
        )

    def true_rad(self, reported_rad: FloatArray, direction: int) -> FloatArray:
        """True angle where one is reported after a move in `direction`, in radians."""
        left_rad = RAD_PER_ARCSEC * self.backlash_arcsec if direction < 0 else 0.0
        waves_rad = wave_rad(self.eccentricity, 1, reported_rad) + wave_rad(self.second_harmonic, 2, reported_rad)
        return np.asarray(reported_rad + waves_rad + left_rad)


class Axis:
    """An axis that turns by a clock; `before_move` is called before every move."""

    def __init__(
        self, name: str, effects: TwoAxesEffects, clock: Clock, options: HeadOptions, before_move: Callable[[], None]
    ) -> None:
        self.name = name
        self.head = SimulatedHead(clock, options, before_move, serial=f"SIM-{name.upper()}")
        self._errors = AxisErrors.of(name, effects)

    def true_rad(self, times_s: FloatArray, tau_s: float) -> FloatArray:
        """True angle at rising clock times as outputs see it that lag by `tau_s`, shape (rows,), in radians."""
        sensed_deg = np.broadcast_to(self.head.move.sensed_deg(times_s, tau_s), times_s.shape)
        return self._errors.true_rad(np.deg2rad(sensed_deg), self.head.direction)
