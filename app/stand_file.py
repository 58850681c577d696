"""Stand files as they are written: what stands where, how well it is known, and how to reach it."""

from collections.abc import Mapping
from datetime import date
from functools import lru_cache
from typing import Self

from pydantic import BaseModel, ConfigDict, Field, create_model, model_validator

from tumble.calibrations.budget import StandUncertainty
from tumble.calibrations.gravity import Gravity, normal_gravity
from tumble.drivers.driver import SIMULATED
from tumble.drivers.names import GivenName
from tumble.drivers.simulated import Simulated
from tumble.drivers.tables import DAQ, HEAD, DaqTable, HeadTable

_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Site(BaseModel):
    """Where the stand is: latitude and height, or a measured gravity."""

    model_config = _STRICT

    latitude_deg: float | None = Field(default=None, ge=-90.0, le=90.0)
    height_m: float = Field(default=0.0, ge=-500.0, le=9000.0)
    gravity_m_s2: float | None = Field(default=None, gt=9.7, lt=9.9)
    gravity_uncertainty_m_s2: float = Field(default=1e-5, ge=0.0)
    """Standard uncertainty of a typed gravity."""
    reference_temperature_degc: float = Field(default=23.0, alias="reference_temperature_degC")

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if self.latitude_deg is not None and self.gravity_m_s2 is not None:
            raise ValueError("latitude_deg and gravity_m_s2 both given: say where the stand is in one of the two ways")
        return self

    @property
    def gravity(self) -> Gravity | None:
        """Local gravity; None where the file says neither of the two."""
        if self.gravity_m_s2 is not None:
            return Gravity(value_m_s2=self.gravity_m_s2, standard_uncertainty_m_s2=self.gravity_uncertainty_m_s2)
        return None if self.latitude_deg is None else normal_gravity(self.latitude_deg, self.height_m)


class StandRecordTable(BaseModel):
    """Whether stored corrections of the stand are applied."""

    model_config = _STRICT

    use: bool = False


class StandFile(BaseModel):
    """A stand file as written."""

    model_config = _STRICT

    name: GivenName
    site: Site = Site()
    head: HeadTable
    daq: DaqTable
    simulated: Simulated | None = None
    stand_record: StandRecordTable = StandRecordTable()

    @property
    def positioners(self) -> Mapping[str, HeadTable]:
        """The tables of the positioners, by name."""
        return {HEAD: self.head}

    @property
    def samplers(self) -> Mapping[str, DaqTable]:
        """The tables of the samplers, by name."""
        return {DAQ: self.daq}

    @property
    def sampling(self) -> DaqTable:
        """Samples and rate of a dwell, which are those of the first sampler."""
        return next(iter(self.samplers.values()))

    @property
    def by_hand(self) -> bool:
        """Whether a person turns a positioner and reads it."""
        return any(table.by_hand for table in self.positioners.values())

    @property
    def simulates(self) -> bool:
        """Whether the unit exists in this process only."""
        return self.daq.driver == SIMULATED

    @property
    def uncertainty(self) -> StandUncertainty:
        """What the stand adds to the budget."""
        return StandUncertainty(
            head_accuracy_arcsec=self.head.accuracy_arcsec,
            seating_arcsec=self.head.seating_arcsec,
            daq_gain=self.daq.gain_uncertainty,
            daq_offset_v=self.daq.offset_uncertainty_v,
            gravity=self.site.gravity,
        )

    def expired(self, on: date) -> list[str]:
        """A sentence for every instrument whose calibration is overdue on a day, see `Instrument.overdue`."""
        instruments = {**self.positioners, **self.samplers}
        return [
            f"stand {self.name}: the calibration of the {name} was due on {table.calibration_due}; have it done"
            for name, table in instruments.items()
            if table.overdue(on)
        ]


class RecordedHead(HeadTable):
    """What every driver's table of a head says alike; its own keys are passed over."""

    model_config = ConfigDict(extra="ignore")


class RecordedDaq(DaqTable):
    """The same of a DAQ."""

    model_config = ConfigDict(extra="ignore")


class RecordedStand(StandFile):
    """What every driver's stand file says alike: an analysis needs no driver, and the driver may be elsewhere."""

    model_config = ConfigDict(extra="ignore")

    head: RecordedHead
    daq: RecordedDaq


@lru_cache(maxsize=32)
def stand_file_with(head: type[HeadTable], daq: type[DaqTable]) -> type[StandFile]:
    """A stand file with the keys of these tables."""
    return create_model("StandFile", __base__=StandFile, head=(head, ...), daq=(daq, ...))
