"""Several tables of one unit as one: a table, and the experiments that were run after it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import reduce
from typing import Any, Final

import numpy as np

from tumble.calibrations.observations import ARRAY_COLUMNS, Observations, SetAside
from tumble.calibrations.support import series
from tumble.calibrations.table import FIELDS

PAUSE_S = 600.0
"""Time between two tables of which nobody knows when they were taken."""
_UNKNOWN: Final[dict[str, Any]] = {"procedure": "", "direction": 0, "temperature_degc": np.nan, "voltage_sd_v": np.nan}
"""Columns that have a value for a row of which they are not known."""
_DEFAULTED = ("row", "angle_deg", "realisation", "mount", "run")
"""Columns that every table has, if only by default."""


def joined(tables: Sequence[Observations], starts_s: Sequence[float | None]) -> Observations:
    """Join tables of one unit, which was seated anew at the start of each.

    Rows and realisations are numbered on. Times go on from table to table: by the clock where it is known when both
    began, otherwise after `PAUSE_S`. A column that only some tables have is unknown in the others, or left out; a
    warning says which.

    Parameters
    ----------
    tables
        In the order in which they were taken, with at least one row each.
    starts_s
        Clock time at which `time_s` of each table is 0, in seconds from any origin that they share; None where unknown.
    """
    if len(tables) == 1:
        return tables[0]
    warnings = [_where(tables)]
    complete = list(_timed(tables, starts_s))
    for name in _partly_there(tables):
        complete = [_with_unknown(table, name) for table in complete]
        lacking = series([table.source for table in tables if _column(table, name) is None])
        kept = "is unknown there" if name in _UNKNOWN else "is left out"
        warnings.append(f"{lacking}: there is no column {_spelt(name)}; it {kept}")
    whole = reduce(appended, complete)
    return replace(whole, warnings=(*whole.warnings, *warnings), source=series([table.source for table in tables]))


def appended(first: Observations, second: Observations) -> Observations:
    """Two tables as one.

    Rows, realisations and runs are numbered on; times are taken as they are. A column that one of them lacks is left
    out, but for the mount, which is face-up by default.
    """
    rows_before = first.rows_read
    second = replace(
        second,
        row=second.row + rows_before,
        realisation=second.realisations + first.realisations.max(initial=0),
        run=second.runs + first.runs.max(initial=0) + 1,
        set_aside=tuple(SetAside(row=entry.row + rows_before, reason=entry.reason) for entry in second.set_aside),
    )
    first = replace(first, realisation=first.realisations, run=first.runs)
    if first.mount is not None or second.mount is not None:
        first, second = (replace(table, mount=table.mounts) for table in (first, second))
    columns: dict[str, Any] = {name: _both(first, second, name) for name in ARRAY_COLUMNS}
    extra: dict[str, Any] = {name: np.concatenate([first.extra[name], second.extra[name]])
                             for name in first.extra if name in second.extra}  # fmt: skip
    return replace(
        first,
        **columns,
        extra=extra,
        set_aside=(*first.set_aside, *second.set_aside),
        warnings=tuple(dict.fromkeys((*first.warnings, *second.warnings))),
        complete=first.complete and second.complete,
    )


def _both(first: Observations, second: Observations, name: str) -> Any:  # noqa: ANN401  # any kind of column
    columns = [getattr(table, name) for table in (first, second)]
    return None if any(column is None for column in columns) else np.concatenate(columns)


def _timed(tables: Sequence[Observations], starts_s: Sequence[float | None]) -> Iterator[Observations]:
    """Tables with their times on the axis of the first."""
    end_s = zero_s = None  # time of the last row so far; clock time at which the axis is 0
    for table, start_s in zip(tables, starts_s, strict=True):
        if table.time_s is None:
            yield table
            continue
        shift_s = 0.0 if end_s is None else end_s + PAUSE_S - float(table.time_s[0])
        if end_s is not None and start_s is not None and zero_s is not None:
            by_clock_s = start_s - zero_s
            shift_s = by_clock_s if by_clock_s + table.time_s[0] > end_s else shift_s
        zero_s = zero_s if start_s is None else start_s - shift_s
        end_s = shift_s + float(table.time_s[-1])
        yield replace(table, time_s=table.time_s + shift_s)


def _partly_there(tables: Sequence[Observations]) -> list[str]:
    """Names of the columns that some tables have and others lack."""
    names = dict.fromkeys([*ARRAY_COLUMNS, *(name for table in tables for name in table.extra)])
    lacking = {name: [_column(table, name) is None for table in tables] for name in names if name not in _DEFAULTED}
    return [name for name, missing in lacking.items() if any(missing) and not all(missing)]


def _column(table: Observations, name: str) -> Any:  # noqa: ANN401  # any kind of column
    return getattr(table, name) if name in ARRAY_COLUMNS else table.extra.get(name)


def _with_unknown(table: Observations, name: str) -> Observations:
    """The table with a column that it lacks, where an unknown value of that can be written."""
    if name not in _UNKNOWN or getattr(table, name) is not None:
        return table
    unknown: dict[str, Any] = {name: np.full(len(table), _UNKNOWN[name])}
    return replace(table, **unknown)


def _spelt(field: str) -> str:
    """A column as tables spell it."""
    return next((column for column, name in FIELDS.items() if name == field), field)


def _where(tables: Sequence[Observations]) -> str:
    """Which rows come from which table."""
    ends = np.cumsum([table.rows_read for table in tables]).tolist()
    parts = [
        f"{end - table.rows_read + 1} to {end} from {table.source}" for table, end in zip(tables, ends, strict=True)
    ]
    return f"rows {series(parts)} are taken together"
