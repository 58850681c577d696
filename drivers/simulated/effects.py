"""What a stand file may inject into the simulated world: the names, keys and units of the catalogue of effects."""

from pydantic import Field, model_validator

from tumble.drivers.simulated.table import Table
from tumble.messages import Message


class Harmonic(Table):
    """Angle error `A sin(n φ + p)` with a known n; true angle = reported + error."""

    amplitude_deg: float
    phase_deg: float = 0.0


class Graduation(Harmonic):
    """Angle error `order` times per turn."""

    order: int = Field(ge=3)


class WarmUp(Table):
    """Bias error `amplitude exp(-t / tau_s)`, t counted from the first switch-on."""

    amplitude: float
    """In V."""
    tau_s: float = Field(gt=0.0)


class Misreading(Table):
    """Dwells, counted from 1, whose true angle is the reported one plus an error."""

    rows: tuple[int, ...]
    error_deg: float | tuple[float, ...]
    """One error for all rows, or one for each."""

    @model_validator(mode="after")
    def _one_error_per_row(self) -> "Misreading":
        if isinstance(self.error_deg, tuple) and len(self.error_deg) != len(self.rows):
            raise ValueError(
                Message(
                    "misreading names {rows} but {errors}; give one error_deg for all, or one for each row",
                    rows=Message.counted("{count} row", "{count} rows", count=len(self.rows)),
                    errors=Message.counted("{count} error", "{count} errors", count=len(self.error_deg)),
                )
            )
        return self

    def by_row(self) -> dict[int, float]:
        """Error of each misread dwell, in degrees."""
        errors = self.error_deg if isinstance(self.error_deg, tuple) else (self.error_deg,) * len(self.rows)
        return dict(zip(self.rows, errors, strict=True))


class DaqNonlinearity(Table):
    """Error `amplitude sin(2 π u / period_V)` of a reading u."""

    amplitude: float
    """In V."""
    period_v: float = Field(gt=0.0, alias="period_V")


class RangeStep(Table):
    """Offset of every reading above a threshold."""

    step: float
    """In V."""
    threshold_v: float = Field(alias="threshold_V")


class UnitEffects(Table):
    """What the unit under test does beyond the declared response."""

    k_xx: float = 0.0
    """V/g², as k_yy, k_zz, k_xz and k_yz."""
    k_yy: float = 0.0
    k_zz: float = 0.0
    k_xz: float = 0.0
    k_yz: float = 0.0
    k_xxx: float = 0.0
    """V/g³."""
    scale_asymmetry: float = 0.0
    """V/g, times |ax|."""
    hysteresis: float = 0.0
    """Half gap once fully reversed, in V; positive: lower after ax rose."""
    bias_temperature: float = 0.0
    """V/K from 23 °C."""
    scale_temperature: float = 0.0
    """V/g/K from 23 °C."""
    bias_drift: float = 0.0
    """V/h."""
    scale_drift: float = 0.0
    """V/g/h."""
    warm_up: WarmUp | None = None
    bias_random_walk: float = Field(default=0.0, ge=0.0)
    """V/√h."""
    realisation_bias: float = Field(default=0.0, ge=0.0)
    """Standard deviation of the bias from one switch-on to another, in V."""
    vibration_rectification: float = 0.0
    """V of bias per V² of variance of the samples."""


class Effects(UnitEffects):
    """Everything that may be injected: the unit's own effects, and those of the stand and of the DAQ."""

    head_eccentricity: Harmonic | None = None
    head_second_harmonic: Harmonic | None = None
    graduation: Graduation | None = None
    backlash: float = 0.0
    """Angle error after a move in - direction, in degrees."""
    axis_tilt: float = 0.0
    """In degrees; positive: the Z end of the head axis points below the horizon."""
    base_tilt_drift: float = 0.0
    """Drift of alpha0, in deg/h."""
    seating: float = Field(default=0.0, ge=0.0)
    """Standard deviation of the angle that each mounting adds, in degrees."""
    misreading: Misreading | None = None
    settling: float = 0.0
    """Fraction of the previous dwell's reading that remains."""
    daq_nonlinearity: DaqNonlinearity | None = None
    range_step: RangeStep | None = None
    latency: float = Field(default=0.0, ge=0.0)
    """By how much a reading is late while the head moves, in seconds."""

    @model_validator(mode="before")
    @classmethod
    def _name_the_unknown(cls, table: object) -> object:
        unknown = sorted(set(table) - set(cls.model_fields)) if isinstance(table, dict) else []
        if unknown:
            raise ValueError(
                Message(
                    "unknown effect {unknown}; known are {known}",
                    unknown=", ".join(map(repr, unknown)),
                    known=", ".join(sorted(cls.model_fields)),
                )
            )
        return table

    def of_the_unit(self) -> list[str]:
        """Names of the unit's own effects that are present."""
        return sorted(self.model_fields_set & set(UnitEffects.model_fields))
