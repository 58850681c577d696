"""Reading stand files, without and with the code that they name."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import date
from hashlib import sha256
from importlib.resources import files
from pathlib import Path
from typing import Any, Final, Self

from tumble.app.stand_file import RecordedDaq, RecordedHead, RecordedStand, Site, StandFile, stand_file_with
from tumble.drivers.driver import SIMULATED, DaqDriver, HeadDriver, find_daq, find_head
from tumble.drivers.own_file import hash_of_file, is_own_file
from tumble.drivers.tables import DaqTable, HeadTable
from tumble.procedures.errors import InputError
from tumble.procedures.toml_lines import parse_toml, place_of, read_text
from tumble.procedures.toml_text import read_toml

__all__ = ["LoadedStand", "RecordedStand", "Site", "StandFile", "WrittenStand", "load_stand", "read_stand"]

_APART: Final = "a simulated head and a simulated daq belong together: a real one does not see the other"


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

    head_driver: HeadDriver | None
    """None for the simulated head."""
    daq_driver: DaqDriver | None
    """None for the simulated DAQ."""


def read_stand(path: Path | None = None) -> WrittenStand:
    """Read a stand file, or the built-in simulated stand where there is no path, and run no file that it names.

    The keys of a driver in such a file are not checked: only the file says what they are.

    Raises
    ------
    InputError
        Unreadable or invalid: file, line, what is wrong and what to do.
    """
    return _Text.at(path).written()


def load_stand(path: Path | None = None) -> LoadedStand:
    """Read a stand file likewise, and load the drivers that it names, which runs their files.

    Raises
    ------
    InputError
        Unreadable or invalid, or a driver cannot be loaded: file, line, what is wrong and what to do.
    """
    text = _Text.at(path)
    written = text.written()
    head = text.head_driver(written.file.head.driver)
    daq = text.daq_driver(written.file.daq.driver)
    file = text.checked(head.table if head else HeadTable, daq.table if daq else DaqTable)
    return LoadedStand(**vars(written) | {"file": file}, head_driver=head, daq_driver=daq)


@dataclass(frozen=True, kw_only=True)
class _Text:
    """The text of a stand file."""

    text: str
    source: str
    path: Path | None

    @classmethod
    def at(cls, path: Path | None) -> Self:
        if path is None:
            built_in = (files("tumble.app") / "stands" / "simulated.toml").read_text("utf-8")
            return cls(text=built_in, source="the built-in stand", path=None)
        return cls(text=read_text(path), source=str(path), path=path)

    @property
    def folder(self) -> Path:
        return self.path.parent if self.path else Path()

    def written(self) -> WrittenStand:
        named = parse_toml(self.text, RecordedStand, self.source)
        return WrittenStand(
            file=self.checked(self._head_table(named.head.driver), self._daq_table(named.daq.driver)),
            path=self.path,
            sha256=sha256(self.text.encode()).hexdigest(),
            recorded=without_simulated(read_toml(self.text, self.source)),
            code_sha256={name: hash_of_file(name, self.folder) for name in sorted(_code_of(named))},
        )

    def checked(self, head: type[HeadTable], daq: type[DaqTable]) -> StandFile:
        file = parse_toml(self.text, stand_file_with(head, daq), self.source)
        if SIMULATED in (file.head.driver, file.daq.driver) and not (file.simulates and _seen(file.head)):
            raise InputError(f"{self.source}: {_APART}; correct it")
        return file

    def head_driver(self, name: str) -> HeadDriver | None:
        with self._blaming("head"):
            return find_head(name, self.folder)

    def daq_driver(self, name: str) -> DaqDriver | None:
        with self._blaming("daq"):
            return find_daq(name, self.folder)

    def _head_table(self, driver: str) -> type[HeadTable]:
        """Keys of the head's table, as far as they are known without running a file."""
        if is_own_file(driver):
            return RecordedHead
        found = self.head_driver(driver)
        return found.table if found else HeadTable

    def _daq_table(self, driver: str) -> type[DaqTable]:
        if is_own_file(driver):
            return RecordedDaq
        found = self.daq_driver(driver)
        return found.table if found else DaqTable

    @contextmanager
    def _blaming(self, table: str) -> Iterator[None]:
        """Tell of a driver that cannot be used with the line that names it."""
        try:
            yield
        except ValueError as error:
            where = place_of(self.source, self.text, (table, "driver"))
            raise InputError(f"{where}: {table}: driver: {error}; correct it") from error


def _code_of(file: StandFile) -> set[str]:
    """The Python files that a stand file names, as `FILE.py:NAME`."""
    simulated = file.simulated
    physics = (simulated.response, simulated.head_error) if simulated else ()
    drivers = (name for name in (file.head.driver, file.daq.driver) if is_own_file(name))
    return {*drivers, *filter(None, physics)}


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
