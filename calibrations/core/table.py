"""Reads and writes tables of any kind of rows: CSV in UTF-8 with one header line, split by `cells`."""

import csv
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.cells import Line, TableError, column_shown, is_missing, number, read_cells, shown
from tumble.calibrations.core.files import read_text
from tumble.calibrations.core.rows import Column, Kind, Rows, SetAside
from tumble.calibrations.core.sentences import series
from tumble.messages import Message

_R = TypeVar("_R", bound=Rows)
_MOST = 2**53
"""Beyond this a floating-point number no longer counts."""
_LISTED = 10
"""Lines that a warning names."""


def read_rows(path: Path, kind: type[_R]) -> _R:
    """Read a table as a kind of rows.

    A row in which a value is missing that every row needs is set aside and listed; one in which an optional value is
    missing is only warned of. Columns that are not declared are kept in `Rows.extra`; one that is declared and empty is
    left out.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    text, warnings = read_text(path)
    header, rows = read_cells(text, path)
    _check_header(header, kind, path)
    empty = _empty(header, rows, kind, path)
    spelt = kind.spelt()
    cells = {name: [line[index] for _, line in rows] for index, name in enumerate(header) if name not in empty}
    read = {name: _column(name, values, kind, [line for line, _ in rows], path) for name, values in cells.items()}
    known: dict[str, Any] = {spelt[name]: values for name, values in read.items() if name in spelt}
    return kind(
        row=np.arange(1, len(rows) + 1),
        extra={name: values for name, values in read.items() if name not in spelt},
        source=str(path),
        warnings=(*warnings, *_missing_warnings(header, empty, rows, kind, path)),
        **known,
    ).without(_without_a_value(header, empty, rows, kind))


def line_of(path: Path, row: int) -> int:
    """Line of the file in which a data row stands, both counted from 1. Raises `TableError` as `read_rows`."""
    _, rows = read_cells(read_text(path)[0], path)
    return rows[row - 1][0]


def write_table(rows: Rows, path: Path) -> None:
    """Write the usable rows as a table, with every digit of every number."""
    known = {name: values for name, field in rows.spelt().items() if (values := getattr(rows, field)) is not None}
    columns = {**known, **rows.extra}
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))


def _declared(name: str, kind: type[Rows]) -> Column | None:
    """What is declared of a column that a table has; None where nothing is."""
    field = kind.spelt().get(name)
    return None if field is None else kind.columns()[field]


def _check_header(header: list[str], kind: type[Rows], path: Path) -> None:
    for name in kind.settings:
        if name not in header:
            raise TableError(
                Message(
                    "{path}, line 1: column {name} is missing; {hint}", path=path, name=name, hint=_hint(name, header)
                )
            )
    if kind.outputs and not set(kind.outputs) & set(header):
        first, *others = kind.outputs
        name = Message("{first} (or {others})", first=first, others=series(others, "or")) if others else first
        raise TableError(
            Message("{path}, line 1: column {name} is missing; {hint}", path=path, name=name, hint=_hint(first, header))
        )


def _empty(header: list[str], rows: list[Line], kind: type[Rows], path: Path) -> list[str]:
    """Names of the columns that hold no value. Raises `TableError` where nothing is left to analyse."""
    empty = [name for place, name in enumerate(header) if all(is_missing(cells[place]) for _, cells in rows)]
    outputs = set(kind.outputs) & set(header)
    for name in kind.settings:
        if name in empty:
            raise TableError(Message("{path}, column {name}: holds no value in any row", path=path, name=name))
    if outputs and outputs <= set(empty):
        raise TableError(Message("{path}, column {name}: holds no value in any row", path=path, name=min(outputs)))
    return empty


def _hint(wanted: str, header: list[str]) -> str:
    quantity = wanted.split("_")[0]
    near = [name for name in header if quantity in name.lower()]
    if near:
        return Message("is it {name}? Rename it and check its unit", name=column_shown(near[0]))
    return Message("the columns are {columns}", columns=shown(", ".join(header))[1:-1])


def _missing_warnings(header: list[str], empty: list[str], rows: list[Line], kind: type[Rows], path: Path) -> list[str]:
    """Sentences on declared columns that are empty, and on rows that are used although a value is missing."""
    warnings: list[str] = [
        Message("{path}: column {name} holds no value and is left out", path=path, name=name)
        for name in empty
        if _declared(name, kind)
    ]
    for name in sorted(set(header) - set(empty)):
        column = _declared(name, kind)
        if column is None or column.unknown is None or column.kind is Kind.TEXT:
            continue
        lines = [line for line, cells in rows if is_missing(cells[header.index(name)])]
        if lines:
            some = ", ".join(map(str, lines[:_LISTED])) + (", …" if len(lines) > _LISTED else "")
            warnings.append(
                Message.counted(
                    "{path}: line {lines} has no {name}; it is used without it",
                    "{path}: {count} rows (lines {lines}) have no {name}; they are used without it",
                    count=len(lines),
                    path=path,
                    lines=some,
                    name=name,
                )
            )
    return warnings


def _without_a_value(header: list[str], empty: list[str], rows: list[Line], kind: type[Rows]) -> tuple[SetAside, ...]:
    """Rows in which a value is missing that every row needs and that has no number for unknown; once each."""
    reasons: dict[int, str] = {}
    for name in kind.spelt():
        if name in header and name not in empty and _cannot_be_unknown(name, kind):
            place = header.index(name)
            for row, (_, cells) in enumerate(rows, start=1):
                if is_missing(cells[place]):
                    reasons.setdefault(row, Message("{name} is missing", name=name))
    return tuple(SetAside(row=row, reason=reason) for row, reason in reasons.items())


def _cannot_be_unknown(name: str, kind: type[Rows]) -> bool:
    column = _declared(name, kind)
    return column is not None and column.kind is not Kind.NUMBER and column.unknown is None


def _column(name: str, cells: list[str], kind: type[Rows], lines: list[int], path: Path) -> NDArray[Any]:
    column = _declared(name, kind)
    if column is not None and column.kind is Kind.TEXT:
        return np.array(_texts(name, cells, column, lines, path), dtype=np.str_)
    try:
        values = np.array([number(cell) for cell in cells])
    except ValueError:
        if column is None:
            return np.array(cells, dtype=np.str_)
        line, cell = next((line, cell) for line, cell in zip(lines, cells, strict=True) if not _is_number(cell))
        fields = {"path": path, "line": line, "name": name, "cell": shown(cell)}
        raise TableError(
            Message("{path}, line {line}, column {name}: {cell} is not a number; write it as a whole number", **fields)
            if column.kind is Kind.WHOLE
            else Message(
                "{path}, line {line}, column {name}: {cell} is not a number; write it with a decimal point, "
                "or nan where there is none",
                **fields,
            )
        ) from None
    return _whole(name, values, column, lines, path) if column is not None and column.kind is Kind.WHOLE else values


def _whole(name: str, values: NDArray[np.float64], column: Column, lines: list[int], path: Path) -> NDArray[np.int64]:
    """Whole numbers, one of the choices where there are any, else from 1."""
    values = np.where(np.isnan(values), 1 if column.unknown is None else column.unknown, values)
    choices = column.choices
    wrong = ~np.isin(values, choices) if choices else ~((values >= 1) & (values <= _MOST) & (values % 1 == 0))
    if wrong.any():
        first = int(np.argmax(wrong))
        expected = series([str(each) for each in choices], "or") if choices else Message("a whole number from 1")
        raise TableError(
            Message(
                "{path}, line {line}, column {name}: {value:g} where {expected} is expected",
                path=path,
                line=lines[first],
                name=name,
                value=values[first],
                expected=expected,
            )
        )
    return values.astype(np.int64)


def _texts(name: str, cells: list[str], column: Column, lines: list[int], path: Path) -> list[str]:
    """The texts of every row, each one of the choices where there are any; the default where one is missing."""
    if not column.choices:
        return cells
    for line, cell in zip(lines, cells, strict=True):
        if cell not in column.choices and not is_missing(cell):
            known = ", ".join(column.choices)
            raise TableError(
                Message(
                    "{path}, line {line}, column {name}: {cell} is no {name}; known are {known}",
                    path=path,
                    line=line,
                    name=name,
                    cell=shown(cell),
                    known=known,
                )
            )
    return [column.default if is_missing(cell) else cell for cell in cells]


def _is_number(cell: str) -> bool:
    try:
        number(cell)
    except ValueError:
        return False
    return True
