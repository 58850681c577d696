"""The `[simulated]` table of a stand file."""

from dataclasses import replace
from typing import Literal

from pydantic import Field, field_validator, model_validator

from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.presets import PRESETS, UnitParameters
from tumble.drivers.simulated.table import SimulatedTable, Table
from tumble.messages import Message

ParameterName = Literal["u0", "kx", "ky", "kz", "kxy", "alpha0_deg"]

VIBRATION_SPREAD = 0.5
"""Spread of the vibration level where rectification is injected: without spread it would only be a bias."""


class Temperature(Table):
    """The room, and the sensor that watches it."""

    start_degc: float = Field(default=23.0, alias="start_degC")
    ramp_k_per_h: float = Field(default=0.0, alias="ramp_K_per_h")
    wander_k: float = Field(default=0.05, ge=0.0, alias="wander_K")
    """Root mean square of a slow, smooth wandering."""
    sensor_noise_k: float = Field(default=0.01, ge=0.0, alias="sensor_noise_K")
    """Standard deviation of the temperature that is reported with one block."""


class Simulated(SimulatedTable):
    """Everything that the simulated world is made of. Explicit values take the place of the preset's."""

    preset: str = "DXL203EB"
    parameters: dict[ParameterName, float] = Field(default_factory=dict)
    noise_v: float | None = Field(default=None, ge=0.0)
    """Standard deviation of one sample, in V."""
    effects: Effects = Effects()
    response: str | None = None
    """`file.py:function` that takes the place of the unit, relative to the stand file."""
    head_error: str | None = None
    """`file.py:function` that adds to the head's angle error, relative to the stand file."""
    flicker_v: float = Field(default=0.0, ge=0.0)
    """Floor of the Allan deviation that the 1/f noise of the unit makes, in V."""
    resolution_v: float = Field(default=1e-6, ge=0.0)
    """Step of the converter, in V; 0 for a converter without steps."""
    range_v: float = Field(default=10.0, gt=0.0)
    """Beyond this the DAQ reports overload, in V."""
    response_tau_s: float = Field(default=0.03, ge=0.0)
    """Time constant with which the output follows the head."""
    hysteresis_reach_g: float = Field(default=0.02, gt=0.0)
    """Half of the change of ax after which the hysteresis is fully reversed, in g."""
    temperature: Temperature = Temperature()
    vibration_spread: float | None = Field(default=None, ge=0.0)
    """Relative spread of the vibration level from dwell to dwell."""

    @field_validator("preset")
    @classmethod
    def _known_preset(cls, name: str) -> str:
        if name not in PRESETS:
            raise ValueError(
                Message("unknown preset {name!r}; known are {known}", name=name, known=", ".join(sorted(PRESETS)))
            )
        return name

    @model_validator(mode="after")
    def _one_unit_only(self) -> "Simulated":
        names = self.effects.of_the_unit()
        if self.response is not None and names:
            raise ValueError(
                Message(
                    "effects of the unit ({names}) have nothing to act on where 'response' takes the place of the "
                    "unit; write them into that function",
                    names=", ".join(names),
                )
            )
        return self

    @property
    def code(self) -> tuple[str, ...]:
        """Python files that the table names."""
        return tuple(filter(None, (self.response, self.head_error)))

    @property
    def unit_parameters(self) -> UnitParameters:
        """The preset's parameters, with what the file states put in their place."""
        return replace(PRESETS[self.preset].parameters, **self.parameters)

    @property
    def sample_noise_v(self) -> float:
        """Standard deviation of one sample at the ordinary vibration level, in V."""
        return PRESETS[self.preset].noise_v if self.noise_v is None else self.noise_v

    @property
    def vibration_level_spread(self) -> float:
        """Relative spread of the vibration level from dwell to dwell."""
        if self.vibration_spread is not None:
            return self.vibration_spread
        return VIBRATION_SPREAD if self.effects.vibration_rectification else 0.0
