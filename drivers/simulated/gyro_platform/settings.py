"""The table `[simulated]` with `world = "gyro_platform"`."""

from typing import Annotated, TypeAlias

from pydantic import Field

from tumble.drivers.simulated.gyro_platform.effects import PlatformEffects
from tumble.drivers.simulated.settings import Temperature
from tumble.drivers.simulated.table import SimulatedTable, Table

Lean: TypeAlias = tuple[Annotated[float, Field(ge=-30.0, le=30.0)], Annotated[float, Field(ge=-30.0, le=30.0)]]
"""Angles γ and κ at pickoff 0, in deg: the base is turned by Rz(α0) Ry(γ) Rx(κ) from east, north and up."""


class GyroNoise(Table):
    """How a rate of the gyro wanders, in the coefficients of an Allan deviation (IEEE 952), and correlated."""

    angle_random_walk_deg_sqrt_h: float = Field(default=5e-4, ge=0.0)
    """N: white noise of the rate; a mean over T hours has the standard deviation N/√T."""
    bias_instability_deg_h: float = Field(default=0.0, ge=0.0)
    """Floor of the Allan deviation."""
    gauss_markov_deg_h: float = Field(default=0.0, ge=0.0)
    """Standard deviation of a first-order Gauss-Markov process."""
    correlation_s: float = Field(default=1000.0, gt=0.0)
    """Its correlation time, 1/μ."""


class SimulatedPlatform(SimulatedTable):
    """Everything that the world of a gyro platform is made of."""

    latitude_deg: float = Field(default=50.45, ge=-90.0, le=90.0)
    alpha0_deg: float = Field(default=-37.2, gt=-180.0, le=180.0)
    """Azimuth of the levelling axis at pickoff 0: from north, counterclockwise seen from above."""
    drift_deg_h: float = 0.35
    """Of the levelling channel."""
    azimuth_drift_deg_h: float = -0.2
    """Of the azimuth channel."""
    leans_deg: Annotated[tuple[Lean, ...], Field(min_length=1)] = ((1.2, -0.8), (-0.9, 1.6))
    """How the base leans as number 1, 2, and so on; beyond that by up to 3° as drawn from the seed."""
    noise: GyroNoise = GyroNoise()
    azimuth_noise: GyroNoise = GyroNoise()
    tilt_noise_deg: float = Field(default=2e-3, ge=0.0)
    """Standard deviation of one sample of a tilt."""
    levelling_tau_s: float = Field(default=0.5, ge=1e-3, le=1e3)
    """Time constant of the levelling loop, 1/m1."""
    temperature: Temperature = Temperature()
    """Of the room, as long as no chamber makes another."""
    unit_tau_s: float = Field(default=900.0, gt=0.0)
    """Time constant with which the platform takes on the temperature of the chamber."""
    range_deg_h: float = Field(default=400.0, gt=0.0)
    """What is beyond is told as an overload."""
    resolution_deg_h: float = Field(default=1e-5, ge=0.0)
    resolution_deg: float = Field(default=1e-5, ge=0.0)
    effects: PlatformEffects = PlatformEffects()
