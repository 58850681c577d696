"""Reading stand files, without and with the code that they name."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Any, Final, Self

from pydantic import BaseModel

from tumble.app.instrument_tables import POSITIONERS, SAMPLERS, Place, places
from tumble.app.stand_file import (
    RecordedChamber,
    RecordedDaq,
    RecordedExciter,
    RecordedHead,
    RecordedStand,
    Site,
    StandFile,
    stand_file_with,
)
from tumble.drivers.driver import (
    SIMULATED,
    ChamberDriver,
    DaqDriver,
    Driver,
    ExciterDriver,
    HeadDriver,
    find_chamber,
    find_daq,
    find_exciter,
    find_head,
)
from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.own_file import hash_of_file, is_own_file
from tumble.drivers.simulated.table import FIRST_WORLD, SimulatedTable
from tumble.drivers.simulated.worlds import find_world
from tumble.drivers.tables import ChamberTable, DaqTable, HeadTable
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.first_method import FIRST
from tumble.procedures.registry import find_method
from tumble.procedures.toml_lines import parse_toml, place_of, read_text
from tumble.procedures.toml_text import read_toml

__all__ = ["LoadedStand", "RecordedStand", "Site", "StandFile", "WrittenStand", "load_stand", "read_stand"]

_RECORDED: Final[Mapping[type[BaseModel], type[BaseModel]]] = {
    HeadTable: RecordedHead,
    DaqTable: RecordedDaq,
    ChamberTable: RecordedChamber,
    ExciterTable: RecordedExciter,
}
_FINDERS: Final = {
    HeadTable: find_head,
    DaqTable: find_daq,
    ChamberTable: find_chamber,
    ExciterTable: find_exciter,
}
_APART: Final = Message("a simulated head and a simulated daq belong together: a real one does not see the other")


@dataclass(frozen=True, kw_only=True)
class WrittenStand:
    """A stand file with where it came from; nothing that it names has been run."""

    file: StandFile
    path: Path | None
    """None for the stand that is built in."""
    sha256: str
    """Of the whole file."""
    recorded: Mapping[str, Any]
    """The file as data without its `simulated` table: what may be recorded."""
    code_sha256: Mapping[str, str]
    """SHA-256 of every Python file that it names, by `FILE.py:NAME`; empty where there is no such file."""

    @property
    def folder(self) -> Path:
        """Where relative paths in the file begin."""
        return self.path.parent if self.path else Path()


@dataclass(frozen=True, kw_only=True)
class LoadedStand(WrittenStand):
    """A stand file with the drivers that it names."""

    positioner_drivers: Mapping[str, HeadDriver | None]
    """By name; None for the simulated head."""
    sampler_drivers: Mapping[str, DaqDriver | None]
    """By name; None for the simulated DAQ."""
    environment_drivers: Mapping[str, ChamberDriver | None] = field(default_factory=dict)
    """By name; None for the simulated chamber."""
    exciter_drivers: Mapping[str, ExciterDriver | None] = field(default_factory=dict)
    """By name; None for the simulated exciter."""


def read_stand(path: Path | None = None, method: str = FIRST) -> WrittenStand:
    """Read a stand file, or the simulated stand that is built in for a method where there is no path.

    No file that it names is run.

    The keys of a driver in such a file are not checked: only the file says what they are.

    Raises
    ------
    InputError
        Unreadable or invalid: file, line, what is wrong and what to do.
    """
    return _Text.at(path, method).written()


def load_stand(path: Path | None = None, method: str = FIRST) -> LoadedStand:
    """Read a stand file likewise, and load the drivers that it names, which runs their files.

    Raises
    ------
    InputError
        Unreadable or invalid, or a driver cannot be loaded: file, line, what is wrong and what to do.
    """
    return _Text.at(path, method).loaded()


def check_stand_text(text: str, path: Path) -> None:
    """Find out whether a text would do as the stand file at a path, as far as that is known without running a file.

    Raises
    ------
    InputError
        As `read_stand`.
    """
    _Text(text=text, source=str(path), path=path).written()


def load_stand_text(text: str, path: Path) -> LoadedStand:
    """What `load_stand` would give if a text were the stand file at a path. Raises as that."""
    return _Text(text=text, source=str(path), path=path).loaded()


@dataclass(frozen=True, kw_only=True)
class _Text:
    """The text of a stand file."""

    text: str
    source: str
    path: Path | None

    @classmethod
    def at(cls, path: Path | None, method: str) -> Self:
        if path is None:
            own = find_method(method).procedure_part.stand
            built_in = own or files("tumble.app") / "stands" / "simulated.toml"
            return cls(text=built_in.read_text("utf-8"), source=Message("the built-in stand"), path=None)
        return cls(text=read_text(path), source=str(path), path=path)

    @property
    def folder(self) -> Path:
        return self.path.parent if self.path else Path()

    @property
    def data(self) -> dict[str, Any]:
        return read_toml(self.text, self.source)

    def written(self) -> WrittenStand:
        self._read_as({place: _RECORDED[place.kind] for place in places(self.data)})
        file = self.checked({place: self._table(place) for place in places(self.data)})
        return WrittenStand(
            file=file,
            path=self.path,
            sha256=sha256(self.text.encode()).hexdigest(),
            recorded=without_simulated(self.data),
            code_sha256={name: hash_of_file(name, self.folder) for name in sorted(_code_of(file))},
        )

    def loaded(self) -> LoadedStand:
        written = self.written()
        drivers = {place: self.driver(place) for place in places(self.data)}
        file = self.checked({place: driver.table if driver else place.kind for place, driver in drivers.items()})
        positioners, samplers, environments, exciters = (
            {place.name: driver for place, driver in drivers.items() if place.kind is kind}
            for kind in (HeadTable, DaqTable, ChamberTable, ExciterTable)
        )
        return LoadedStand(
            **vars(written) | {"file": file},
            positioner_drivers=positioners,
            sampler_drivers=samplers,
            environment_drivers=environments,
            exciter_drivers=exciters,
        )

    def checked(self, tables: Mapping[Place, type[BaseModel]]) -> StandFile:
        file = self._read_as(tables)
        if not _of_one_kind(file):
            raise InputError(Message("{source}: {mistake}; correct it", source=self.source, mistake=_APART))
        return file

    def _read_as(self, tables: Mapping[Place, type[BaseModel]]) -> StandFile:
        single, positioners, samplers = (
            tuple((place.name, kind) for place, kind in tables.items() if place.location[:-1] == outer)
            for outer in ((), (POSITIONERS,), (SAMPLERS,))
        )
        return parse_toml(self.text, stand_file_with(self._world(), single, positioners, samplers), self.source)

    def _world(self) -> type[SimulatedTable]:
        """Keys of the table `simulated`, by the world that it names. Raises `InputError`."""
        table = self.data.get("simulated")
        name = table.get("world", FIRST_WORLD) if isinstance(table, Mapping) else FIRST_WORLD
        try:
            return find_world(str(name)).table
        except ValueError as error:
            where = place_of(self.source, self.text, ("simulated", "world"))
            raise InputError(
                Message("{where}: simulated: world: {error}; correct it", where=where, error=error)
            ) from error

    def driver(self, place: Place) -> Driver[Any, Any] | None:
        name = str(place.table(self.data).get("driver", ""))
        try:
            return _FINDERS[place.kind](name, self.folder)
        except ValueError as error:
            where = place_of(self.source, self.text, (*place.location, "driver"))
            raise InputError(
                Message("{where}: {table}: driver: {error}; correct it", where=where, table=place.where, error=error)
            ) from error

    def _table(self, place: Place) -> type[BaseModel]:
        """Keys of an instrument's table, as far as they are known without running a file."""
        if is_own_file(str(place.table(self.data)["driver"])):
            return _RECORDED[place.kind]
        found = self.driver(place)
        return found.table if found else place.kind


def _code_of(file: StandFile) -> set[str]:
    """The Python files that a stand file names, as `FILE.py:NAME`."""
    drivers = (table.driver for table in file.instruments.values() if is_own_file(table.driver))
    return {*drivers, *(file.simulated.code if file.simulated else ())}


def same_instruments(recorded: Mapping[str, Any], loaded: LoadedStand) -> bool:
    """Whether a stand file in a recording names the stand and the instruments of one that is loaded.

    True where nothing was recorded, as for a table; due dates, limits and uncertainties may differ.
    """
    return not recorded or _instruments(recorded) == _instruments(loaded.recorded)


def _instruments(data: Mapping[str, Any]) -> dict[str, Any]:
    keys = ("driver", "url", "interface", "channel", "serial")
    tables = {place.location: place.table(data) for place in places(data)}
    return {"name": data.get("name")} | {
        ".".join(location): {key: table[key] for key in keys if key in table} for location, table in tables.items()
    }


def _of_one_kind(file: StandFile) -> bool:
    """Whether everything is simulated that belongs together, or nothing is."""
    simulated = [table.driver == SIMULATED for table in file.samplers.values()]
    if not any(simulated):
        return not any(table.driver == SIMULATED for table in file.instruments.values())
    simulated += [table.driver == SIMULATED for table in (*file.environments.values(), *file.exciters.values())]
    moving = bool(file.positioners or file.exciters)
    return all(simulated) and moving and all(map(_seen, file.positioners.values()))


def _seen(head: HeadTable) -> bool:
    """Whether a simulated DAQ sees what the head does: it is simulated too, or a person turns the simulated one.

    Whether a person turns the head of a file that was not run is not known.
    """
    return head.driver == SIMULATED or head.by_hand or isinstance(head, RecordedHead)


def without_simulated(data: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a stand file without `simulated`, dates as ISO 8601 text."""
    return {key: _plain(value) for key, value in data.items() if key != "simulated"}


def _plain(value: Any) -> Any:  # noqa: ANN401  # whatever TOML holds
    if isinstance(value, Mapping):
        return {key: _plain(inner) for key, inner in value.items()}
    return value.isoformat() if isinstance(value, date) else value
