"""What a stand file may inject into the world of vibration: names, keys and units of the catalogue of the method."""

from typing import Annotated

from pydantic import BeforeValidator, Field

from tumble.drivers.simulated.table import Table


class Value(Table):
    """One number, in the unit of its effect; a plain number stands for it."""

    value: float = 0.0


def _table(found: object) -> object:
    return {"value": found} if isinstance(found, int | float) else found


Plain = Annotated[Value, BeforeValidator(_table)]


class FrequencyResponse(Table):
    """A resonance of the unit's element: what it feels is the motion times `1 / (1 - (f / natural_hz)²)`."""

    natural_hz: float = Field(gt=0.0)


class ShakerCross(Table):
    """Motion along y in phase with that along x."""

    ratio: float = 0.0


class ThermalShift(Table):
    """Bias that the power of the drive leaves: `amplitude x`, `tau ẋ = ½ level² - x`."""

    amplitude: float = 0.0
    """µg/g²."""
    tau_s: float = Field(default=300.0, gt=0.0)


class Spin(Table):
    """The sensing point is so many millimetres off the axis of the table of a centrifuge, along the input axis."""

    mm: float = 0.0


class Clipping(Table):
    """The output stops above so much."""

    limit_g: float = Field(gt=0.0)


class AfterShift(Table):
    """A step of the bias after a dwell, counted from 1, to the end of its mounting."""

    step: float
    """µg."""
    row: int = Field(ge=1)


class Misreading(Table):
    """Dwells, counted from 1, whose output is off by so much."""

    rows: tuple[int, ...]
    error: float
    """µg."""


class VibrationEffects(Table):
    """Everything that may be injected."""

    k_iii: Plain = Value()
    """µg/g³."""
    k_iiii: Plain = Value()
    """µg/g⁴."""
    frequency_response: FrequencyResponse | None = None
    shaker_cross: ShakerCross = ShakerCross()
    table_lean: Plain = Value()
    """Lean of the table under load, µg/g² of ½ level² along x."""
    drive_pickup: Plain = Value()
    """DC that the drive leaves in the output, µg/g."""
    thermal_shift: ThermalShift | None = None
    spin: Spin = Spin()
    clipping: Clipping | None = None
    after_shift: AfterShift | None = None
    bias_drift: Plain = Value()
    """µg/h."""
    bias_temperature: Plain = Value()
    """µg/K from 23 °C."""
    bias_random_walk: Plain = Value()
    """µg/√h."""
    realisation_bias: Plain = Value()
    """Standard deviation from one switch-on to another, µg."""
    misreading: Misreading | None = None
