"""Stand files as they are written: what stands where, how well it is known, and how to reach it."""

from collections.abc import Mapping
from datetime import date
from functools import lru_cache
from typing import Any, Self, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, create_model, model_validator

from tumble.app.instrument_tables import POSITIONERS, SAMPLERS, Tables, tables_of
from tumble.calibrations.core.gravity import Gravity, normal_gravity
from tumble.drivers.driver import SIMULATED
from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.names import GivenName, Name
from tumble.drivers.simulated.table import SimulatedTable
from tumble.drivers.tables import CHAMBER, DAQ, EXCITER, HEAD, ChamberTable, DaqTable, HeadTable
from tumble.drivers.text import check_name
from tumble.messages import Message
from tumble.procedures.errors import InputError

_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Laboratory(BaseModel):
    """Whose stand it is, as the first page of a report says."""

    model_config = _STRICT

    name: Name = ""
    address: Name = ""


class Site(BaseModel):
    """Where the stand is: latitude and height, or a measured gravity."""

    model_config = _STRICT

    latitude_deg: float | None = Field(default=None, ge=-90.0, le=90.0)
    latitude_uncertainty_deg: float | None = Field(default=None, ge=0.0, le=90.0)
    """Standard uncertainty of the latitude; None where nobody states it."""
    height_m: float = Field(default=0.0, ge=-500.0, le=9000.0)
    gravity_m_s2: float | None = Field(default=None, gt=9.7, lt=9.9)
    gravity_uncertainty_m_s2: float = Field(default=1e-5, ge=0.0)
    """Standard uncertainty of a typed gravity."""
    reference_temperature_degc: float = Field(default=23.0, alias="reference_temperature_degC")

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if self.latitude_deg is not None and self.gravity_m_s2 is not None:
            raise ValueError(
                Message("latitude_deg and gravity_m_s2 both given: say where the stand is in one of the two ways")
            )
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
    laboratory: Laboratory = Laboratory()
    site: Site = Site()
    head_table: HeadTable | None = Field(default=None, alias=HEAD)
    daq_table: DaqTable | None = Field(default=None, alias=DAQ)
    named_positioners: Tables = Field(default=Tables(), alias=POSITIONERS)
    named_samplers: Tables = Field(default=Tables(), alias=SAMPLERS)
    chamber_table: ChamberTable | None = Field(default=None, alias=CHAMBER)
    exciter_table: ExciterTable | None = Field(default=None, alias=EXCITER)
    simulated: SimulatedTable | None = None
    """By the kind of world that it names."""
    stand_record: StandRecordTable = StandRecordTable()

    @model_validator(mode="after")
    def _each_name_once(self) -> Self:
        names = [*self.positioners, *self.samplers, *self.environments, *self.exciters]
        for name in names:
            check_name(name)
        if twice := next((name for name in names if names.count(name) > 1), None):
            raise ValueError(Message("two instruments are called {twice}: give one of them another name", twice=twice))
        if not self.samplers:
            raise ValueError(
                Message("there is nothing that measures: add [{daq}] or [{samplers}.NAME]", daq=DAQ, samplers=SAMPLERS)
            )
        return self

    @property
    def positioners(self) -> Mapping[str, HeadTable]:
        """The tables of the positioners, by name."""
        return ({HEAD: self.head_table} if self.head_table else {}) | self.named_positioners.by_name

    @property
    def samplers(self) -> Mapping[str, DaqTable]:
        """The tables of the samplers, by name."""
        return ({DAQ: self.daq_table} if self.daq_table else {}) | self.named_samplers.by_name

    @property
    def environments(self) -> Mapping[str, ChamberTable]:
        """The table of the temperature chamber, by the condition that it sets."""
        return {CHAMBER: self.chamber_table} if self.chamber_table else {}

    @property
    def exciters(self) -> Mapping[str, ExciterTable]:
        """The table of the exciter, by the condition that it sets."""
        return {EXCITER: self.exciter_table} if self.exciter_table else {}

    @property
    def most(self) -> Mapping[str, float]:
        """The greatest magnitude of a sample, by channel, beyond which an excitation is ended."""
        return self.exciter_table.most_v if self.exciter_table else {}

    @property
    def quiet(self) -> Mapping[str, float]:
        """The greatest scatter of the samples of a channel while the exciter rests."""
        return self.exciter_table.quiet_v if self.exciter_table else {}

    @property
    def instruments(self) -> Mapping[str, HeadTable | DaqTable | ChamberTable | ExciterTable]:
        """The tables of all instruments, by name."""
        return {**self.positioners, **self.samplers, **self.environments, **self.exciters}

    @property
    def head(self) -> HeadTable:
        """The table of the dividing head. Raises `InputError` where the stand has none."""
        if self.head_table is None:
            raise InputError(
                Message(
                    "stand {name}: has no [{head}], and this needs a dividing head; name another stand",
                    name=self.name,
                    head=HEAD,
                )
            )
        return self.head_table

    @property
    def daq(self) -> DaqTable:
        """The table of the voltmeter. Raises `InputError` where the stand has none."""
        if self.daq_table is None:
            raise InputError(
                Message(
                    "stand {name}: has no [{daq}], and this needs a voltmeter; name another stand",
                    name=self.name,
                    daq=DAQ,
                )
            )
        return self.daq_table

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
        return any(table.driver == SIMULATED for table in self.samplers.values())

    def expired(self, on: date) -> list[str]:
        """A sentence for every instrument whose calibration is overdue on a day, see `Instrument.overdue`."""
        return [
            Message(
                "stand {stand}: the calibration of the {instrument} was due on {date}; have it done",
                stand=self.name,
                instrument=name,
                date=table.calibration_due,
            )
            for name, table in self.instruments.items()
            if table.overdue(on)
        ]


class RecordedHead(HeadTable):
    """What every driver's table of a head says alike; its own keys are passed over."""

    model_config = ConfigDict(extra="ignore")


class RecordedDaq(DaqTable):
    """The same of a DAQ."""

    model_config = ConfigDict(extra="ignore")


class RecordedChamber(ChamberTable):
    """The same of a temperature chamber."""

    model_config = ConfigDict(extra="ignore")


class RecordedExciter(ExciterTable):
    """The same of an exciter."""

    model_config = ConfigDict(extra="ignore")


class RecordedStand(BaseModel):
    """What an analysis reads of any stand file, with or without its drivers; a method adds the tables that it needs."""

    model_config = ConfigDict(frozen=True, extra="ignore", allow_inf_nan=False)

    name: GivenName
    site: Site = Site()
    stand_record: StandRecordTable = StandRecordTable()


TablesOf: TypeAlias = tuple[tuple[str, type[BaseModel]], ...]
"""Names and schemas of tables."""


@lru_cache(maxsize=32)
def stand_file_with(
    simulated: type[SimulatedTable], single: TablesOf, positioners: TablesOf, samplers: TablesOf
) -> type[StandFile]:
    """A stand file with the keys of these tables: `single` are `head` and `daq`, as far as they must be there."""
    fields: dict[str, Any] = {f"{name}_table": (kind, Field(alias=name)) for name, kind in single}
    fields["simulated"] = (simulated | None, None)
    if positioners:
        fields["named_positioners"] = (tables_of(dict(positioners)), Field(alias=POSITIONERS))
    if samplers:
        fields["named_samplers"] = (tables_of(dict(samplers)), Field(alias=SAMPLERS))
    return create_model("StandFile", __base__=StandFile, **fields)
