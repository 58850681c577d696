"""A table of parameters, one run of calibration a line, with the temperature of each."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.cells import Line, TableError, holds_numbers, is_missing
from tumble.calibrations.core.cells import number as as_number
from tumble.calibrations.core.files import read_lines
from tumble.calibrations.core.rows import OVERLOAD, SetAside
from tumble.calibrations.core.screening import SENSORS_DEGC
from tumble.calibrations.methods.temperature.clock import clock_s
from tumble.calibrations.methods.temperature.columns import Column, column_of, named
from tumble.messages import Message

_ORDER = "run"
_FEWEST = 4
_KELVIN = 200.0
"""No sensor is calibrated at so many degrees Celsius throughout."""
_LOG_S = 60.0
"""Runs of calibration do not follow each other so fast."""
_LOG_ROWS = 200
"""Nor are there so many."""
_FAR = 100.0
"""A value so many times as far from all others as these from each other is none."""


@dataclass(frozen=True, kw_only=True)
class Runs:
    """Parameters of several runs, in the order in which these were made."""

    temperature_degc: FloatArray
    """Of the sensor, shape (runs,)."""
    temperature_name: str
    """Column from which it comes."""
    order: FloatArray
    time_s: FloatArray | None
    """When each was made, by `clock_s`; None where no column says it."""
    parameters: Mapping[str, FloatArray]
    """Values by the name of the column, unit included."""
    source: str
    set_aside: tuple[SetAside, ...] = ()
    """Runs in which a value is missing."""

    def __len__(self) -> int:
        """Return the number of runs."""
        return len(self.temperature_degc)


def read_runs(path: Path) -> Runs:
    """Read a table of parameters from which a model is to be made: `read_later` with four runs or more.

    Raises
    ------
    TableError
        As there; or fewer than four runs, or all at one temperature.
    """
    runs = read_later(path)
    if len(runs) < _FEWEST or np.ptp(runs.temperature_degc) <= 0:
        raise TableError(
            Message(
                "{path}: so few runs ({runs}) at so few temperatures ({temperatures}) tell nothing",
                path=path,
                runs=len(runs),
                temperatures=len(np.unique(runs.temperature_degc)),
            )
        )
    return runs


def read_later(path: Path) -> Runs:
    """Read a table of parameters: `run` and a time (`time_s`, `time_h`) where known, temperatures `…_degC`, parameters.

    The temperature is that of the sensor (`sensor_degC`) where there are several, else the first. Times, counts and
    remarks are no parameters.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file, or one that is a log and no table of runs.
    """
    header, lines = read_lines(path)
    numbers = {name: place for place, name in enumerate(header) if holds_numbers(place, lines)}
    lines, set_aside = _complete(numbers, lines)
    columns = {name: _numbers(name, place, lines, path) for name, place in numbers.items()}
    temperatures = named(list(columns), Column.TEMPERATURE)
    if not temperatures:
        raise TableError(Message("{path}: no column of a temperature (…_degC) holds numbers; correct it", path=path))
    at = "sensor_degC" if "sensor_degC" in temperatures else temperatures[0]
    parameters = {name: values for name, values in columns.items() if column_of(name) is Column.PARAMETER}
    if not parameters:
        raise TableError(
            Message(
                "{path}, line 1: there is no parameter beside the temperature; add a column for each, its unit "
                "in its name",
                path=path,
            )
        )
    _check_temperatures(at, columns[at], lines, path)
    time_s = clock_s(columns)
    _check_pace(time_s, len(lines), path)
    for name, values in parameters.items() if len(lines) >= _FEWEST else ():
        _check_gross(name, values, lines, path)
    return Runs(
        temperature_degc=columns[at],
        temperature_name=at,
        order=_order(columns, len(lines)),
        time_s=time_s,
        parameters=parameters,
        source=str(path),
        set_aside=set_aside,
    )


def _complete(numbers: Mapping[str, int], lines: list[Line]) -> tuple[list[Line], tuple[SetAside, ...]]:
    """Runs in which nothing is missing, and the others with what is; a `nan` that somebody wrote is no missing cell."""
    missing = {
        row: next((name for name, place in numbers.items() if _is_blank(cells[place])), "")
        for row, (_, cells) in enumerate(lines)
    }
    aside = tuple(
        SetAside(row=row + 1, reason=Message("{name} has no value", name=name)) for row, name in missing.items() if name
    )
    return [line for row, line in enumerate(lines) if not missing[row]], aside


def _is_blank(cell: str) -> bool:
    return is_missing(cell) and cell.lower() != "nan"


def _check_temperatures(name: str, values_degc: FloatArray, lines: Sequence[Line], path: Path) -> None:
    if values_degc.min() > _KELVIN:
        raise TableError(
            Message(
                "{path}, column {name}: temperatures from {lowest:g} to {highest:g} °C; are these kelvin? Write "
                "degrees Celsius",
                path=path,
                name=name,
                lowest=values_degc.min(),
                highest=values_degc.max(),
            )
        )
    unlikely = (values_degc < SENSORS_DEGC[0]) | (values_degc > SENSORS_DEGC[1])
    if unlikely.any():
        row = int(np.argmax(unlikely))
        raise TableError(
            Message(
                "{path}, line {line}, column {name}: no sensor of a run reads {value_degc:g} °C; is it in another "
                "unit? Correct it or leave the run out",
                path=path,
                line=lines[row][0],
                name=name,
                value_degc=values_degc[row],
            )
        )


def _check_pace(time_s: FloatArray | None, runs: int, path: Path) -> None:
    """Refuse a log: rows that follow each other as no runs of calibration can."""
    pace_s = float("inf") if time_s is None or runs < 2 else float(np.median(np.diff(np.sort(time_s))))
    if pace_s < _LOG_S or runs > _LOG_ROWS:
        rows = (
            Message.counted("{count} row", "{count} rows", count=runs)
            if pace_s >= _LOG_S
            else Message("rows {pace_s:g} s apart", pace_s=pace_s)
        )
        raise TableError(
            Message(
                "{path}: {rows} look like a log and not like runs of calibration; give one row for each run, or "
                "angle_deg with the output",
                path=path,
                rows=rows,
            )
        )


def _check_gross(name: str, values: FloatArray, lines: Sequence[Line], path: Path) -> None:
    """Refuse a value that is of another order than all the others."""
    row = int(np.argmax(np.abs(values - np.median(values))))
    others = np.delete(values, row)
    spread = float(np.ptp(others))
    if spread > 0 and abs(values[row] - np.median(others)) > _FAR * spread:
        raise TableError(
            Message(
                "{path}, line {line}, column {name}: {value:g} lies more than {times:.0f} times as far from the "
                "other runs as these from each other; correct it or leave the run out",
                path=path,
                line=lines[row][0],
                name=name,
                value=values[row],
                times=_FAR,
            )
        )


def _order(columns: Mapping[str, FloatArray], runs: int) -> FloatArray:
    """Which run was made when: as the table says, by its times, or else line by line."""
    if _ORDER in columns:
        return columns[_ORDER]
    if times := [name for name in columns if column_of(name) is Column.TIME]:
        return np.argsort(np.argsort(columns[times[0]])).astype(np.float64) + 1.0
    return np.arange(1.0, runs + 1)


def _numbers(name: str, place: int, lines: Sequence[Line], path: Path) -> FloatArray:
    values = []
    for number, cells in lines:
        try:
            value = as_number(cells[place])
        except ValueError:
            raise TableError(
                Message(
                    "{path}, line {line}, column {name}: {cell!r} is not a number",
                    path=path,
                    line=number,
                    name=name,
                    cell=cells[place],
                )
            ) from None
        if not abs(value) < OVERLOAD:
            raise TableError(
                Message(
                    "{path}, line {line}, column {name}: {cell} is no value; leave the run out",
                    path=path,
                    line=number,
                    name=name,
                    cell=cells[place],
                )
            )
        values.append(value)
    return np.array(values)
