"""Several tables of one unit as one: a table, and the experiments that were run after it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import reduce
from typing import Any, TypeVar

import numpy as np

from tumble.calibrations.core.rows import Rows, SetAside
from tumble.calibrations.core.sentences import series
from tumble.messages import Message

PAUSE_S = 600.0
"""Time between two tables of which nobody knows when they were taken."""
_R = TypeVar("_R", bound=Rows)


def joined(tables: Sequence[_R], starts_s: Sequence[float | None]) -> _R:
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
        unknown = tables[0].columns()[name].unknown if name in tables[0].columns() else None
        complete = [_with_unknown(table, name) for table in complete]
        lacking = series([table.source for table in tables if table.values(name) is None])
        spelt = _spelt(tables[0], name)
        warnings.append(
            Message("{sources}: there is no column {name}; it is left out", sources=lacking, name=spelt)
            if unknown is None
            else Message("{sources}: there is no column {name}; it is unknown there", sources=lacking, name=spelt)
        )
    whole = reduce(appended, complete)
    return replace(whole, warnings=(*whole.warnings, *warnings), source=series([table.source for table in tables]))


def appended(first: _R, second: _R) -> _R:
    """Two tables as one.

    Rows, realisations and runs are numbered on; times are taken as they are. A column that one of them lacks is left
    out, but for those that have a default.
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
    columns: dict[str, Any] = {name: _both(first, second, name) for name in first.columns()}
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


def _both(first: Rows, second: Rows, name: str) -> Any:  # noqa: ANN401  # any kind of column
    """A column of two tables: with its default where one of them lacks it, None where it has none or both lack it."""
    columns, default = [getattr(table, name) for table in (first, second)], first.columns()[name].default
    if all(column is None for column in columns):
        return None
    filled = [
        np.full(len(table), default) if column is None and default is not None else column
        for table, column in zip((first, second), columns, strict=True)
    ]
    return None if any(column is None for column in filled) else np.concatenate(filled)


def _timed(tables: Sequence[_R], starts_s: Sequence[float | None]) -> Iterator[_R]:
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


def _partly_there(tables: Sequence[Rows]) -> list[str]:
    """Names of the columns that some tables have and others lack."""
    declared = tables[0].columns()
    asked = [name for name, column in declared.items() if column.default is None]
    names = dict.fromkeys([*asked, *(name for table in tables for name in table.extra)])
    lacking = {name: [table.values(name) is None for table in tables] for name in names}
    return [name for name, missing in lacking.items() if any(missing) and not all(missing)]


def _with_unknown(table: _R, name: str) -> _R:
    """The table with a column that it lacks, where an unknown value of that can be written."""
    column = table.columns().get(name)
    if column is None or column.unknown is None or getattr(table, name) is not None:
        return table
    unknown: dict[str, Any] = {name: np.full(len(table), column.unknown)}
    return replace(table, **unknown)


def _spelt(table: Rows, name: str) -> str:
    """A column as tables spell it."""
    return (table.columns()[name].name if name in table.columns() else "") or name


def _where(tables: Sequence[Rows]) -> str:
    """Which rows come from which table."""
    ends = np.cumsum([table.rows_read for table in tables]).tolist()
    parts = [
        Message("{first} to {last} from {source}", first=end - table.rows_read + 1, last=end, source=table.source)
        for table, end in zip(tables, ends, strict=True)
    ]
    return Message("rows {parts} are taken together", parts=series(parts))
