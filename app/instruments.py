"""The tables `[head]` and `[daq]` of a stand file."""

from datetime import date
from typing import Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from procedures.programme import MOST_SAMPLES

_CAN = ("cia402", "can")
_SERIAL = ("zaber", "scpi")


class Instrument(BaseModel):
    """What every instrument may carry."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    driver: str
    url: str = ""
    """A serial port or anything else that pyserial opens; for CAN `INTERFACE:CHANNEL?OPTION=VALUE`."""
    baud_rate: int = Field(default=115_200, ge=50, le=4_000_000)
    interface: str = ""
    """Interface of python-can, with `channel` and `options` in place of `url`."""
    channel: str = ""
    options: dict[str, int | float | str] = {}
    serial: str = ""
    certificate: str = ""
    calibration_due: date | None = None

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        on_can = bool(self.interface and self.channel)
        if self.driver in _SERIAL and not self.url:
            raise ValueError(f"the driver {self.driver} needs a url: a port name, or such as socket://127.0.0.1:7001")
        if self.driver in _CAN and on_can == bool(self.url):
            raise ValueError(
                f"the driver {self.driver} needs interface and channel, or a url such as socketcan:can0, and not both"
            )
        return self

    @property
    def address(self) -> str:
        """Where the instrument is found: what two processes cannot both use; empty where it has no address."""
        options = "".join(f" {name}={value}" for name, value in sorted(self.options.items()))
        return self.url or f"{self.interface}:{self.channel}".strip(":") + options


class HeadTable(Instrument):
    """The dividing head."""

    driver: Literal["simulated", "zaber", "cia402", "manual"]
    steps_per_deg: float = 1000.0
    """Counts of the device per degree, sign included."""
    limits_deg: tuple[float, float]
    """Soft limits; there is no 'unlimited'."""
    cable_turns: float | None = Field(default=None, gt=0.0)
    """Turns to either side of zero that the cable of the unit allows; without it, what the limits allow."""
    speed_deg_s: float = Field(default=20.0, ge=1e-3, le=1e4)
    device: int = Field(default=1, ge=1, le=99)
    """Number in a chain of Zaber devices."""
    axis: int = Field(default=1, ge=1, le=9)
    node: int = Field(default=1, ge=1, le=127)
    """Number on CANopen."""
    setting_tolerance_arcsec: float = Field(default=60.0, gt=0.0)
    """A reading by hand that differs from the setting by more is asked for again."""
    accuracy_arcsec: float = Field(default=0.0, ge=0.0)
    """Standard uncertainty of the reading."""
    seating_arcsec: float = Field(default=0.0, ge=0.0)
    """Repeatability of the unit in its seat, per mounting."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        low, high = self.limits_deg
        if not low < high:
            raise ValueError(f"limits_deg: {low:g} is not below {high:g}")
        if self.steps_per_deg == 0:
            raise ValueError("steps_per_deg is 0: give the counts per degree")
        return self

    @property
    def turns(self) -> float:
        """Turns to either side of zero that the cable is trusted with."""
        return max(map(abs, self.limits_deg)) / 360.0 if self.cable_turns is None else self.cable_turns


class DaqTable(Instrument):
    """The voltmeter."""

    driver: Literal["simulated", "scpi", "can"]
    samples: int = Field(default=100, ge=2, le=MOST_SAMPLES)
    """Per dwell, unless the programme says otherwise."""
    rate_hz: float = Field(default=100.0, ge=1e-2, le=1e6)
    range_v: float | None = Field(default=10.0, gt=0.0, le=1000.0)
    """Range of a multimeter."""
    temperature_sensor: str | None = None
    """Parameters of `CONF:TEMP` of a multimeter with a sensor."""
    dbc: str = ""
    """DBC file of a CAN DAQ, relative to the stand file; without it the one that comes along."""
    gain_uncertainty: float = Field(default=0.0, ge=0.0)
    offset_uncertainty_v: float = Field(default=0.0, ge=0.0)
