"""Cells of a delimited text table, as laboratories and their spreadsheets write them.

Commas between values, or semicolons or tabs with decimal points or commas; `#` lines, blank lines, rows of separators
and nameless empty columns are passed over. A spreadsheet's error (`#N/A`, `#DIV/0!`) is a missing value and never a
comment, wherever it stands.
"""

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Final

from tumble.messages import Message

MISSING: Final = frozenset({"", "-", "--", "—", "na", "n/a", "nan", "null", "none"})
"""What stands for no value, in any case of letters."""
_SPREADSHEET_ERROR = re.compile(
    r"#[^\W\d_'/]+(['/][^\W_']+)*[!?]|#(N/A|N/D|Н/Д|Н/П|NV|GETTING_DATA)|(Err|Fehler):\d{3}"
)
"""Excel's and LibreOffice's errors in the languages that end them in ! or ?, and those that do not."""
_ERRORS_BEGIN: Final = ("#", "E", "F")
_DELIMITERS: Final = {";": Message("semicolons"), "\t": Message("tabs")}
_MINUS = str.maketrans(dict.fromkeys("\u2212\u2013\ufe63\uff0d", "-"))
"""What a word processor makes of a minus."""
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?")
_SHOWN: Final = 40
"""Characters of a cell that a message repeats."""
_LONGEST_UNIT: Final = 3
"""Letters of a unit that another language writes otherwise."""

_UNFINISHED: Final = Message("unexpected end of data")
_QUOTED_IN_PART: Final = Message("a value goes on after a closing quotation mark")

Line = tuple[int, list[str]]
"""Number of a line in the file, from 1, and its cells."""


class TableError(ValueError):
    """A table that cannot be read; the message names file, line and column and says what to do."""


def read_cells(text: str, path: Path) -> tuple[list[str], list[Line]]:
    """Return the header and the rows below it, numbers with a decimal point and an ASCII minus.

    Raises
    ------
    TableError
        No header or no row, a name twice or none, a ragged line, two kinds of decimal sign.
    """
    lines = _lines(text, path)
    first = next(lines, None)
    if first is None:
        raise TableError(Message("{path}: the file is empty; expected a header line and one row per dwell", path=path))
    delimiter = _delimiter(first[1])
    number, header = first[0], _split(first, delimiter, path)[1]
    rows = [cells for cells in (_split(line, delimiter, path) for line in lines) if any(cells[1])]
    if not rows:
        raise TableError(Message("{path}: there is a header but no row; expected one row per dwell", path=path))
    header, rows = _named(header, rows, number, path)
    if delimiter != ",":
        _check_decimal_signs(rows, path)
    return header, [(line, [_ascii_number(cell, delimiter) for cell in cells]) for line, cells in rows]


def header_cells(text: str, path: Path) -> list[str]:
    """Names of the columns of a table of which `text` is the beginning; none without one. Raises `TableError`."""
    first = next(_lines(text, path), None)
    return _split(first, _delimiter(first[1]), path)[1] if first else []


def is_missing(cell: str) -> bool:
    """Whether a cell holds no value: empty, a word for nothing, or a spreadsheet's error."""
    return cell.lower() in MISSING or (cell[:1] in _ERRORS_BEGIN and bool(_SPREADSHEET_ERROR.fullmatch(cell)))


def number(cell: str) -> float:
    """Return a decimal number, NaN where the value is missing; Python's own 1_000 is none. Raises `ValueError`."""
    try:
        read = float(cell)
    except ValueError:
        if is_missing(cell):
            return float("nan")
        raise
    if "_" in cell:
        raise ValueError(cell)
    return read


def shown(cell: str) -> str:
    """Return a cell as a message repeats it: quoted, without control characters, and not at any length."""
    return repr(cell if len(cell) <= _SHOWN else f"{cell[:_SHOWN]}…")


def column_shown(name: str) -> str:
    """Return a column's name as a message repeats it: as a cell, unless it is one word, and too long for a unit."""
    return name if name.isidentifier() and len(name) > _LONGEST_UNIT else shown(name)


def _lines(text: str, path: Path) -> Iterator[tuple[int, str]]:
    """Numbered lines that hold anything, without comments and without a spreadsheet's own `sep=;`."""
    if "\0" in text:
        where = text[: text.index("\0")].count("\n") + 1
        raise TableError(
            Message(
                "{path}, line {line}: holds a NUL byte; this is no text table, save it as CSV in UTF-8",
                path=path,
                line=where,
            )
        )
    for count, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or _is_comment(line) or (count == 1 and re.fullmatch(r"sep=.", line.strip())):
            continue
        yield count, line


def _is_comment(line: str) -> bool:
    return line.startswith("#") and not _SPREADSHEET_ERROR.fullmatch(re.split(r"[,;\t]", line, maxsplit=1)[0].strip())


def _delimiter(header: str) -> str:
    return next((mark for mark in _DELIMITERS if mark in header and "," not in header), ",")


def _split(line: tuple[int, str], delimiter: str, path: Path) -> Line:
    count, text = line
    try:
        return count, [cell.strip() for cell in next(csv.reader([text], delimiter=delimiter, strict=True))]
    except csv.Error as error:
        between = _DELIMITERS.get(delimiter, Message("commas"))
        raise TableError(
            Message(
                "{path}, line {line}: {error}; expected plain values between {between}",
                path=path,
                line=count,
                error=_csv_reason(error),
                between=between,
            )
        ) from error


def _csv_reason(error: csv.Error) -> str:
    """What is wrong with quotation marks, as a message."""
    if str(error) == _UNFINISHED:
        return _UNFINISHED
    return _QUOTED_IN_PART if "expected after" in str(error) else str(error)


def _named(header: list[str], rows: list[Line], header_line: int, path: Path) -> tuple[list[str], list[Line]]:
    """The columns that have a name, each of its own; one without a name must be empty."""
    kept = [place for place, name in enumerate(header) if name]
    names = [header[place] for place in kept]
    double = next((name for name in names if names.count(name) > 1), "")
    if double:
        raise TableError(
            Message(
                "{path}, line {line}, column {name}: named twice; rename or remove one",
                path=path,
                line=header_line,
                name=shown(double)[1:-1],
            )
        )
    return names, [(line, _cells(cells, header, kept, line, path)) for line, cells in rows]


def _cells(cells: list[str], header: list[str], kept: list[int], line: int, path: Path) -> list[str]:
    width = len(header)
    if len(cells) < width or any(cells[width:]):
        raise TableError(
            Message.counted(
                "{path}, line {line}: {count} value where the header has {columns}; complete the line or remove it",
                "{path}, line {line}: {count} values where the header has {columns}; complete the line or remove it",
                path=path,
                line=line,
                count=len(cells),
                columns=Message.counted("{count} column", "{count} columns", count=width),
            )
        )
    nameless = next((place for place in range(width) if not header[place] and cells[place]), None)
    if nameless is not None:
        raise TableError(
            Message(
                "{path}, line {line}: {cell} stands in column {column}, which has no name; name the column or "
                "remove it",
                path=path,
                line=line,
                cell=shown(cells[nameless]),
                column=nameless + 1,
            )
        )
    return [cells[place] for place in kept]


def _check_decimal_signs(rows: Iterable[Line], path: Path) -> None:
    """Refuse a table in which some numbers have a decimal comma and others a point."""
    first: dict[str, int] = {}
    for line, cells in rows:
        for sign in (",", "."):
            if sign not in first and any(sign in cell and _NUMBER.fullmatch(cell.translate(_MINUS)) for cell in cells):
                first[sign] = line
    if len(first) > 1:
        raise TableError(
            Message(
                "{path}, line {line}: numbers with a decimal point and numbers with a decimal comma (line "
                "{comma_line}); write all of them with a point",
                path=path,
                line=max(first.values()),
                comma_line=first[","],
            )
        )


def _ascii_number(cell: str, delimiter: str) -> str:
    """The cell, as Python reads it where it is a number."""
    if cell.isascii() and "," not in cell:
        return cell
    plain = cell.translate(_MINUS)
    if not _NUMBER.fullmatch(plain) or (delimiter == "," and "," in plain):
        return cell
    return plain.replace(",", ".")


def holds_numbers(place: int, lines: Sequence[tuple[int, Sequence[str]]]) -> bool:
    """Whether any cell of a column is a number; a column of remarks is left out."""
    return any(_is_number(cells[place]) for _, cells in lines)


def _is_number(cell: str) -> bool:
    try:
        return not math.isnan(number(cell)) or cell.lower() == "nan"
    except ValueError:
        return False
