"""Stand files: what stands where, how well it is known, and how to reach it."""

import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import date
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field, create_model, model_validator

from calibrations.budget import StandUncertainty
from calibrations.gravity import Gravity, normal_gravity
from drivers.driver import SIMULATED, DaqDriver, HeadDriver, find_daq, find_head
from drivers.simulated import Simulated
from drivers.tables import DaqTable, HeadTable
from procedures.errors import InputError
from procedures.toml_lines import parse_toml, place_of, read_text

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

    name: str = Field(min_length=1)
    site: Site = Site()
    head: HeadTable
    daq: DaqTable
    simulated: Simulated | None = None
    stand_record: StandRecordTable = StandRecordTable()

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
        instruments = {"head": self.head, "daq": self.daq}
        return [
            f"stand {self.name}: the calibration of the {name} was due on {table.calibration_due}; have it done"
            for name, table in instruments.items()
            if table.overdue(on)
        ]


class _RecordedHead(HeadTable):
    model_config = ConfigDict(extra="ignore")


class _RecordedDaq(DaqTable):
    model_config = ConfigDict(extra="ignore")


class RecordedStand(StandFile):
    """What every driver's stand file says alike: an analysis needs no driver, and the driver may be elsewhere."""

    model_config = ConfigDict(extra="ignore")

    head: _RecordedHead
    daq: _RecordedDaq


@dataclass(frozen=True, kw_only=True)
class LoadedStand:
    """A stand file with where it came from, and the drivers that it names."""

    file: StandFile
    head_driver: HeadDriver | None
    """None for the simulated head."""
    daq_driver: DaqDriver | None
    """None for the simulated DAQ."""
    path: Path | None
    """None for the stand that is built in."""
    sha256: str
    """Of the whole file."""
    recorded: Mapping[str, Any]
    """The file as data without its `simulated` table: what may be recorded."""

    @property
    def folder(self) -> Path:
        """Where relative paths in the file begin."""
        return self.path.parent if self.path else Path()


def load_stand(path: Path | None = None) -> LoadedStand:
    """Read a stand file, or the built-in simulated stand where there is no path.

    Raises
    ------
    InputError
        Unreadable or invalid: file, line, what is wrong and what to do.
    """
    text = (files("app") / "stands" / "simulated.toml").read_text("utf-8") if path is None else read_text(path)
    source = "the built-in stand" if path is None else str(path)
    folder = path.parent if path else Path()
    named = parse_toml(text, RecordedStand, source)
    with _blaming("head", text, source):
        head_driver = find_head(named.head.driver, folder)
    with _blaming("daq", text, source):
        daq_driver = find_daq(named.daq.driver, folder)
    file = parse_toml(text, _model(head_driver, daq_driver), source)
    if SIMULATED in (file.head.driver, file.daq.driver) and not (file.simulates and _seen(file.head)):
        happened = "a simulated head and a simulated daq belong together: a real one does not see the other"
        raise InputError(f"{source}: {happened}; correct it")
    return LoadedStand(
        file=file,
        head_driver=head_driver,
        daq_driver=daq_driver,
        path=path,
        sha256=sha256(text.encode()).hexdigest(),
        recorded=without_simulated(tomllib.loads(text)),
    )


def same_instruments(recorded: Mapping[str, Any], loaded: LoadedStand) -> bool:
    """Whether a stand file in a recording names the stand and the instruments of one that is loaded.

    True where nothing was recorded, as for a table; due dates, limits and uncertainties may differ.
    """
    return not recorded or _instruments(recorded) == _instruments(loaded.recorded)


def _instruments(data: Mapping[str, Any]) -> dict[str, Any]:
    places = ("driver", "url", "interface", "channel", "serial")
    tables = {name: data.get(name, {}) for name in ("head", "daq")}
    return {"name": data.get("name")} | {
        name: {place: table[place] for place in places if place in table} for name, table in tables.items()
    }


def _model(head: HeadDriver | None, daq: DaqDriver | None) -> type[StandFile]:
    """A stand file with the keys of its drivers."""
    head_table = head.table if head else HeadTable
    daq_table = daq.table if daq else DaqTable
    return create_model("StandFile", __base__=StandFile, head=(head_table, ...), daq=(daq_table, ...))


def _seen(head: HeadTable) -> bool:
    """Whether a simulated DAQ sees what the head does: it is simulated too, or a person turns the simulated one."""
    return head.driver == SIMULATED or head.by_hand


@contextmanager
def _blaming(table: str, text: str, source: str) -> Iterator[None]:
    """Tell of a driver that cannot be used with the line that names it."""
    try:
        yield
    except ValueError as error:
        where = place_of(source, text, (table, "driver"))
        raise InputError(f"{where}: {table}: driver: {error}; correct it") from error


def without_simulated(data: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a stand file without `simulated`, dates as ISO 8601 text."""
    return {key: _plain(value) for key, value in data.items() if key != "simulated"}


def _plain(value: Any) -> Any:  # noqa: ANN401  # whatever TOML holds
    if isinstance(value, Mapping):
        return {key: _plain(inner) for key, inner in value.items()}
    return value.isoformat() if isinstance(value, date) else value
