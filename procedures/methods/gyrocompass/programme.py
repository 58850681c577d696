"""Programmes of a gyro platform: positions, repeated, on one base or on several."""

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar, Literal, Self, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.layout import Layout
from tumble.procedures.methods.gyrocompass.layout import AZIMUTH, LAYOUT, LEVELLING_RATE, TILT_BETA, TILT_GAMMA
from tumble.procedures.methods.gyrocompass.layout import AZIMUTH_RATE as AZIMUTH_CHANNEL
from tumble.procedures.methods.gyrocompass.positions import Positions
from tumble.procedures.programme import Limit, Programme, check_ends
from tumble.procedures.steps import Dwell

GyrocompassParameter: TypeAlias = Literal["alpha0", "drift"]
_HORIZONTAL_DEG_H = 9.6
"""Of the earth's rate at middle latitudes."""


class NoiseTable(BaseModel):
    """How the rate of the gyro wanders, as declared: coefficients of an Allan deviation, or a Gauss-Markov process."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    angle_random_walk_deg_sqrt_h: float = Field(default=0.0, ge=0.0)
    """N."""
    bias_instability_deg_h: float = Field(default=0.0, ge=0.0)
    """B: the floor of the Allan deviation is 0.664 B."""
    rate_random_walk_deg_h_sqrt_h: float = Field(default=0.0, ge=0.0)
    """K."""
    gauss_markov_deg_h: float = Field(default=0.0, ge=0.0)
    """Standard deviation of a first-order Gauss-Markov process."""
    correlation_s: float = Field(default=1000.0, gt=0.0)
    """Its correlation time."""

    @model_validator(mode="after")
    def _some(self) -> Self:
        told = self.model_dump(exclude={"correlation_s"})
        if not any(told.values()):
            raise ValueError(Message("the noise is nowhere greater than 0; give one of {names}", names=", ".join(told)))
        return self


class GyrocompassProgramme(Programme):
    """Positions of the turntable. Limits: alpha0 in deg, drift in °/h."""

    layout: ClassVar[Layout] = LAYOUT

    method: Literal["gyrocompass"]
    procedures: tuple[Positions, ...] = Field(min_length=1, alias="procedure")
    dwell_s: float | None = Field(default=10.0, gt=0.0, le=86_400.0)
    """Averaging time."""
    settle_s: float = Field(default=7.0, ge=0.0)
    """Wait after a turn: some ten time constants of the levelling loop."""
    settle_timeout_s: float = Field(default=60.0, gt=0.0)
    tilt_within_deg: float = Field(default=0.05, gt=0.0)
    """How far the platform may be off level when a dwell begins, where the stand has a channel tilt_beta_deg."""
    tilt_rate_deg_h: float | None = Field(default=None, gt=0.0)
    """How fast it may still be levelling then, by two consecutive blocks; without it, what noise explains."""
    noise: NoiseTable | None = None
    """With it, a plan says how uncertain the heading will be, and a run what it is if the gyro is so."""
    limits: Mapping[GyrocompassParameter, Limit] = Field(default_factory=dict)  # type: ignore[assignment]  # fewer keys

    @model_validator(mode="after")
    def _ends_one_day(self) -> Self:
        check_ends(self.realisations * sum(each.poses for each in self.procedures))
        return self

    @property
    def parts(self) -> tuple[Positions, ...]:
        """The lists, in order."""
        return self.procedures

    def acquisition(self, *, samples: int, rate_hz: float) -> Acquisition:
        """How a dwell is taken: once the platform is level and no longer levelling."""
        usual = super().acquisition(samples=samples, rate_hz=rate_hz)
        block_s = usual.settle_samples / rate_hz
        change = {} if self.tilt_rate_deg_h is None else {TILT_BETA: self.tilt_rate_deg_h / 3600.0 * block_s}
        return replace(usual, settle_within={TILT_BETA: self.tilt_within_deg}, settle_change=change)

    def nominal(self, dwell: Dwell) -> Mapping[str, float]:
        """Channels of a level platform whose levelling axis points east at pickoff 0."""
        sine = float(np.sin(np.deg2rad(dwell.targets_deg[AZIMUTH])))
        return {LEVELLING_RATE: _HORIZONTAL_DEG_H * sine, AZIMUTH_CHANNEL: 0.0, TILT_GAMMA: 0.0}
