"""What a stand file may inject into the world of a gyro platform: names, keys and units of the catalogue."""

from pydantic import Field

from tumble.drivers.simulated.table import Table


class Wave(Table):
    """`A sin(n δ + p)` with a known n."""

    amplitude_deg: float = 0.0
    phase_deg: float = 0.0


class Graduation(Wave):
    """The same with an order of its own."""

    order: int = Field(ge=3)


class DriftWarmUp(Table):
    """`amplitude exp(-t / tau_s)`, in °/h, from the first switch-on."""

    amplitude: float = 0.0
    tau_s: float = Field(default=600.0, gt=0.0)


class AzimuthMisreading(Table):
    """Dwells, counted from 1, whose true angle is the reported one plus an error."""

    rows: tuple[int, ...]
    error_deg: float


class PlatformEffects(Table):
    """Everything that may be injected."""

    drift_ramp: float = 0.0
    """°/h²."""
    drift_warm_up: DriftWarmUp = DriftWarmUp()
    drift_temperature: float = 0.0
    """°/h/K from 23 °C."""
    drift_random_walk: float = Field(default=0.0, ge=0.0)
    """°/h/√h."""
    realisation_drift: float = Field(default=0.0, ge=0.0)
    """Standard deviation of the drift from one switch-on to another, in °/h."""
    torquer_scale: float = 0.0
    """Fraction by which a rate is told too great."""
    torquer_asymmetry: float = 0.0
    """Fraction of the magnitude of the rate."""
    torquer_square: float = 0.0
    """1/(°/h)."""
    latitude: float = 0.0
    """By how much the true latitude is greater than `latitude_deg`, in deg."""
    g_unbalance: float = 0.0
    """°/h/g of gravity along the levelling axis."""
    tilt_scale: float = 0.0
    """Fraction by which a tilt is told too great."""
    tilt_bias: float = 0.0
    """deg."""
    pickoff_eccentricity: Wave = Wave()
    pickoff_second_harmonic: Wave = Wave()
    pickoff_graduation: Graduation | None = None
    pickoff_scale: float = 0.0
    """Fraction by which the true angle is greater than the reported one."""
    backlash: float = 0.0
    """By how much the true angle is greater after a move in - direction, in deg."""
    base_yaw: float = 0.0
    """Turn of the base, in deg/h."""
    settling: float = 0.0
    """Fraction of the previous dwell's rate that remains."""
    misreading: AzimuthMisreading | None = None
