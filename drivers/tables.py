"""The tables `[head]` and `[daq]` of a stand file: what they all may say, and what a way to an instrument adds.

A driver that has keys of its own derives its table from one of these; see `tumble.drivers.driver`.
"""

import re
from collections.abc import Mapping
from datetime import date, datetime
from typing import Annotated, ClassVar, Final, Literal, Self, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator
from pydantic_core import PydanticCustomError

from tumble.drivers.links.can_address import CanAddress, Option
from tumble.drivers.links.places import check_network, check_scheme, check_server
from tumble.drivers.names import GivenName, Name
from tumble.messages import Message

HEAD: Final = "head"
DAQ: Final = "daq"
"""Tables of a stand file, and the names of these instruments at the stand."""
CHAMBER: Final = "chamber"
"""The same of a temperature chamber; also the condition of dwells that it sets, a temperature in °C as text."""
EXCITER: Final = "exciter"
"""The same of what shakes the unit; its condition is an excitation as text."""
TITLES: Final = {
    HEAD: Message("dividing head"),
    DAQ: Message("DAQ"),
    CHAMBER: Message("temperature chamber"),
    EXCITER: Message("exciter"),
}
"""What sentences call them."""
MOUNT: Final = "mount"
"""The condition of a dwell that the seat on the head limits: how the unit sits there."""
MOST_SAMPLES: Final = 10_000_000
"""More in one dwell is a slip of the pen."""

_TURN_ARCSEC: Final = 360.0 * 3600.0
_DAY: Final = re.compile(r"\d{4}-\d{2}-\d{2}", re.ASCII)

Mount: TypeAlias = Literal["face-up", "face-up-90", "face-down", "edge", "edge-back", "end"]


class Instrument(BaseModel):
    """What every instrument may carry."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    driver: str
    """Name of a driver that is installed, or `FILE.py:NAME`, the file being relative to the stand file."""
    url: str = ""
    serial: Name = ""
    certificate: Name = ""
    calibration_due: date | None = None

    @field_validator("url")
    @classmethod
    def _possible(cls, url: str) -> str:
        check_network(url)
        return url

    @field_validator("calibration_due", mode="before")
    @classmethod
    def _day(cls, due: object) -> object:
        """A day and nothing else: numbers would be taken for seconds since 1970."""
        if due is None or (isinstance(due, date) and not isinstance(due, datetime)):
            return due
        if isinstance(due, str) and _DAY.fullmatch(due):
            return date.fromisoformat(due)
        raise PydanticCustomError("day", "Input should be a valid date, such as 2027-01-31")

    def overdue(self, on: date) -> bool:
        """Whether the calibration is past its due date on a day; on that date itself it still holds."""
        return self.calibration_due is not None and self.calibration_due < on

    @property
    def address(self) -> str:
        """Where the instrument is found, see `tumble.drivers.links.places`; empty where it has no address."""
        return self.url


class OnSerialLine(Instrument):
    """An instrument on a serial line; `url` is a port name or anything else that pyserial opens."""

    baud_rate: int = Field(default=115_200, ge=50, le=4_000_000)

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        if not self.url:
            raise ValueError(
                Message(
                    "the driver {driver} needs a url: a port name, or such as socket://127.0.0.1:7001",
                    driver=self.driver,
                )
            )
        check_scheme(self.url)
        return self


class OnCan(Instrument):
    """An instrument on CAN; `url` is `INTERFACE:CHANNEL?OPTION=VALUE`."""

    interface: str = ""
    """Interface of python-can, with `channel` and `options` in place of `url`."""
    channel: str = ""
    options: dict[str, Option] = {}

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        if bool(self.interface and self.channel) == bool(self.url):
            raise ValueError(
                Message(
                    "the driver {driver} needs interface and channel, or a url such as socketcan:can0, and not both",
                    driver=self.driver,
                )
            )
        check_server(self.bus)  # which raises, too, where the url names none
        return self

    @property
    def bus(self) -> CanAddress:
        """The bus that it is on."""
        if self.url:
            return CanAddress.from_url(self.url)
        return CanAddress(interface=self.interface, channel=self.channel, options=self.options)

    @property
    def address(self) -> str:
        """The bus as one line of text."""
        return self.bus.url


class HeadTable(Instrument):
    """The dividing head."""

    by_hand: ClassVar[bool] = False
    """Whether a person turns the head and reads it."""

    steps_per_deg: float = 1000.0
    """Counts of the device per degree, sign included."""
    limits_deg: tuple[float, float]
    """Soft limits; there is no 'unlimited'."""
    cable_turns: float | None = Field(default=None, gt=0.0)
    """Turns to either side of zero that the cable of the unit allows; without it, what the limits allow."""
    speed_deg_s: float = Field(default=20.0, ge=1e-3, le=1e4)
    accuracy_arcsec: float | None = Field(default=None, ge=0.0, le=_TURN_ARCSEC)
    """Standard uncertainty of the reading; None where nobody states it."""
    seating_arcsec: float | None = Field(default=None, ge=0.0, le=_TURN_ARCSEC)
    """Repeatability of the unit in its seat, per mounting; None where nobody states it."""
    mounts: tuple[Mount, ...] | None = Field(default=None, min_length=1)
    """Mounts that the seat allows; without it, all."""
    mounting_s: float = Field(default=60.0, ge=0.0, le=86_400.0)
    """Time in which an operator seats the unit."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        low, high = self.limits_deg
        if not low < high:
            raise ValueError(Message("limits_deg: {low:g} is not below {high:g}", low=low, high=high))
        if self.steps_per_deg == 0:
            raise ValueError(Message("steps_per_deg is 0: give the counts per degree"))
        return self

    @property
    def allowed(self) -> Mapping[str, tuple[str, ...] | None]:
        """What the seat on it allows, by condition; None allows everything."""
        return {MOUNT: self.mounts}

    @property
    def turns(self) -> float:
        """Turns to either side of zero that the cable is trusted with."""
        return max(map(abs, self.limits_deg)) / 360.0 if self.cable_turns is None else self.cable_turns


class DaqTable(Instrument):
    """The voltmeter."""

    samples: int = Field(default=100, ge=2, le=MOST_SAMPLES)
    """Per dwell, unless the programme says otherwise."""
    rate_hz: float = Field(default=100.0, ge=1e-2, le=1e6)
    gain_uncertainty: float | None = Field(default=None, ge=0.0, lt=1.0)
    """Relative standard uncertainty; None where nobody states it."""
    offset_uncertainty_v: float | None = Field(default=None, ge=0.0, le=100.0)
    """Standard uncertainty; None where nobody states it."""
    uncertainties: dict[GivenName, Annotated[float, Field(ge=0.0)]] = Field(default_factory=dict)
    """Standard uncertainty of the offset of channels that are no voltages, by channel, in the unit of each."""
    channels: tuple[GivenName, ...] = ()
    """Names of its channels in their order, the unit in each (`u_x_v`); without it those of the driver."""


class ChamberTable(Instrument):
    """The temperature chamber."""

    limits_degc: tuple[float, float] = Field(alias="limits_degC")
    """Set points that may be asked for."""
    ramp_k_per_min: float | None = Field(default=None, alias="ramp_K_per_min", gt=0.0, le=1000.0)
    """The steepest change of the set point that unit and chamber may be given; without it, a step at once."""
    safe_degc: float | None = Field(default=None, alias="safe_degC")
    """Set point in which it is left at the end of a run; without it, it is switched off."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        low, high = self.limits_degc
        if not low < high:
            raise ValueError(Message("limits_degC: {low:g} is not below {high:g}", low=low, high=high))
        if self.safe_degc is not None and not low <= self.safe_degc <= high:
            raise ValueError(Message("safe_degC: {safe:g} is outside limits_degC", safe=self.safe_degc))
        return self
