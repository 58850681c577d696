"""A table of parameters, one run of calibration a line, with the temperature of each."""

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.table import TableError, read_lines

_TEMPERATURE = re.compile(r"_degC$")
_ORDER = "run"
_TIME = "time_s"


@dataclass(frozen=True, kw_only=True)
class Runs:
    """Parameters of several runs, in the order in which these were made."""

    temperature_degc: FloatArray
    """Of the sensor, shape (runs,)."""
    temperature_name: str
    """Column from which it comes."""
    order: FloatArray
    time_s: FloatArray | None
    parameters: Mapping[str, FloatArray]
    """Values by the name of the column, unit included."""
    source: str

    def __len__(self) -> int:
        """Return the number of runs."""
        return len(self.temperature_degc)


def unit_of(name: str) -> str:
    """Unit in the name of a column: what stands after its last underscore; none where there is no underscore."""
    return name.rsplit("_", 1)[1] if "_" in name else ""


def holds_runs(path: Path) -> bool:
    """Whether a file is a table of parameters against temperature: it has a temperature, and no angle of a head."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            header = next((row for row in csv.reader(file) if row and not row[0].startswith("#")), [])
    except (OSError, UnicodeDecodeError, csv.Error):
        return False
    names = [name.strip() for name in header]
    return "angle_deg" not in names and "voltage_V" not in names and any(map(_TEMPERATURE.search, names))


def read_runs(path: Path) -> Runs:
    """Read a table of parameters: `run`, `time_s` where they are given, temperatures `…_degC`, then parameters.

    The temperature is that of the sensor (`sensor_degC`) where there are several, else the first. A column whose name
    ends in a unit has that unit.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file, or one with fewer than four runs.
    """
    header, lines = read_lines(path)
    columns = {
        name: _numbers(name, place, lines, path) for place, name in enumerate(header) if _holds_numbers(place, lines)
    }
    temperatures = [name for name in columns if _TEMPERATURE.search(name)]
    if not temperatures:
        raise TableError(f"{path}: no column of a temperature (…_degC) holds numbers; correct it")
    named = "sensor_degC" if "sensor_degC" in temperatures else temperatures[0]
    others = {_ORDER, _TIME, *temperatures}
    parameters = {name: values for name, values in columns.items() if name not in others}
    if not parameters:
        raise TableError(f"{path}, line 1: there is no parameter beside the temperature; add a column for each")
    if len(lines) < _FEWEST or np.ptp(columns[named]) <= 0:
        raise TableError(f"{path}: {len(lines)} runs at {len(np.unique(columns[named]))} temperatures tell nothing")
    return Runs(
        temperature_degc=columns[named],
        temperature_name=named,
        order=_order(columns, len(lines)),
        time_s=columns.get(_TIME),
        parameters=parameters,
        source=str(path),
    )


_FEWEST = 4
_LARGEST = 1e30
"""Beyond this a value is none."""


def _order(columns: Mapping[str, FloatArray], runs: int) -> FloatArray:
    """Which run was made when: as the table says, by its times, or else line by line."""
    if _ORDER in columns:
        return columns[_ORDER]
    if _TIME in columns:
        return np.argsort(np.argsort(columns[_TIME])).astype(np.float64) + 1.0
    return np.arange(1.0, runs + 1)


def _holds_numbers(place: int, lines: list[tuple[int, list[str]]]) -> bool:
    """Whether any cell of a column is a number; a column of remarks is left out."""
    for _, cells in lines:
        try:
            float(cells[place])
        except ValueError:
            continue
        return True
    return False


def _numbers(name: str, place: int, lines: list[tuple[int, list[str]]], path: Path) -> FloatArray:
    values = []
    for number, cells in lines:
        try:
            value = float(cells[place])
        except ValueError:
            raise TableError(f"{path}, line {number}, column {name}: {cells[place]!r} is not a number") from None
        if not abs(value) < _LARGEST:
            raise TableError(f"{path}, line {number}, column {name}: {cells[place]} is no value; leave the run out")
        values.append(value)
    return np.array(values)
