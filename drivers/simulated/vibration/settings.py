"""The table `[simulated]` with `world = "vibration"`."""

from typing import Literal, TypeAlias

from pydantic import Field

from tumble.drivers.simulated.settings import Temperature
from tumble.drivers.simulated.table import SimulatedTable, Table
from tumble.drivers.simulated.vibration.effects import VibrationEffects

UnitParameter: TypeAlias = Literal["bias", "k_ii", "k_oo", "k_pp", "k_io", "k_ip"]

NOMINAL: dict[UnitParameter, float] = {
    "bias": 420.0, "k_ii": 22.0, "k_oo": -6.0, "k_pp": 9.0, "k_io": 14.0, "k_ip": -8.0,
}  # fmt: skip
"""A unit like any other: bias in µg, the others in µg/g²."""


class Distortion(Table):
    """Harmonics of a shaker, as fractions of the fundamental, and their phases against it."""

    second: float = Field(default=0.0, ge=0.0, le=1.0)
    second_phase_deg: float = 0.0
    third: float = Field(default=0.0, ge=0.0, le=1.0)
    third_phase_deg: float = 0.0


class SimulatedVibration(SimulatedTable):
    """Everything that the world of vibration is made of."""

    parameters: dict[UnitParameter, float] = Field(default_factory=dict)
    """In place of `NOMINAL`; units as there."""
    scale_v_per_g: float = 1.0
    """Scale factor of the unit."""
    reference_v_per_g: float = 0.1
    """True sensitivity of every reference accelerometer."""
    noise_ug: float = Field(default=300.0, ge=0.0)
    """Standard deviation of one sample of the output."""
    reference_noise_ug: float = Field(default=300.0, ge=0.0)
    distortion: Distortion = Distortion()
    frequency_error: float = Field(default=0.0, gt=-0.5, lt=0.5)
    """By which the drive is off its nominal frequency, relative."""
    level_error: float = Field(default=0.0, gt=-0.9, lt=9.0)
    """By which the motion is off its nominal level, relative."""
    arm_m: float = Field(default=0.5, gt=0.0)
    """Of a double centrifuge."""
    tilt_arcsec: float = 0.0
    """By which the axis of its arm is off the vertical."""
    mounting: str = "x along i, y along o, p down"
    """How the unit sits at the beginning."""
    effects: VibrationEffects = VibrationEffects()
    resolution_v: float = Field(default=1e-7, ge=0.0)
    """Step of the converter; 0 for one without steps."""
    range_v: float = Field(default=50.0, gt=0.0)
    temperature: Temperature = Temperature()
    """Of the room."""

    @property
    def unit_parameters(self) -> dict[UnitParameter, float]:
        """All parameters, with what the file states put in their place."""
        return {**NOMINAL, **self.parameters}
