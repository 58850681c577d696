"""The table `[simulated]` with `world = "two_axes"`."""

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from tumble.drivers.simulated.settings import Temperature
from tumble.drivers.simulated.table import SimulatedTable
from tumble.drivers.simulated.two_axes.effects import TwoAxesEffects

UnitParameter: TypeAlias = Literal[
    "bias_x", "bias_y", "bias_z", "scale_x", "scale_y", "scale_z",
    "m_xy", "m_xz", "m_yx", "m_yz", "m_zx", "m_zy", "level_x", "level_y",
]  # fmt: skip
_Deviation: TypeAlias = Annotated[float, Field(ge=0.0)]

NOMINAL: dict[UnitParameter, float] = {
    "bias_x": 0.0031, "bias_y": -0.0018, "bias_z": 0.0012,
    "scale_x": 1.012, "scale_y": 0.991, "scale_z": 1.004,
    "m_xy": 210.0, "m_xz": -340.0, "m_yx": -160.0, "m_yz": 280.0, "m_zx": 95.0, "m_zy": -120.0,
    "level_x": 25.0, "level_y": -15.0,
}  # fmt: skip
"""A unit like any other: biases in V, scale factors in V/g, misalignments and levels in arc seconds."""


class SimulatedTwoAxes(SimulatedTable):
    """Everything that the world of two axes is made of."""

    parameters: dict[UnitParameter, float] = Field(default_factory=dict)
    """In place of `NOMINAL`; units as there."""
    noise_v: tuple[_Deviation, _Deviation, _Deviation] = (1.6e-4, 1.0e-4, 2.5e-4)
    """Standard deviation of one sample of each channel, in V."""
    crosstalk: tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]] = (
        (0.0, 0.0, 0.0),
        (0.0, 0.0, 0.0),
        (0.0, 0.0, 0.0),
    )
    """Fraction of the output of each channel (column) that is added to each (row)."""
    effects: TwoAxesEffects = TwoAxesEffects()
    resolution_v: float = Field(default=1e-6, ge=0.0)
    """Step of the converter, in V; 0 for a converter without steps."""
    range_v: float = Field(default=10.0, gt=0.0)
    response_tau_s: float = Field(default=0.03, ge=0.0)
    """Time constant with which the outputs follow the axes."""
    temperature: Temperature = Temperature()
    """Of the room, as long as no chamber makes another."""
    unit_tau_s: float = Field(default=400.0, gt=0.0)
    """Time constant with which the unit takes on the temperature of the chamber."""

    @property
    def unit_parameters(self) -> dict[UnitParameter, float]:
        """All parameters, with what the file states put in their place."""
        return {**NOMINAL, **self.parameters}
