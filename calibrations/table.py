"""Reads and writes observation tables (CSV: UTF-8, comma, one header line, decimal point, `#` lines ignored)."""

import csv
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from calibrations.bounded import MOST_ROWS, read_bounded
from calibrations.geometry import MOUNTS
from calibrations.observations import Observations
from calibrations.screening import set_aside_bad_rows

FIELDS = {
    "time_s": "time_s",
    "realisation": "realisation",
    "procedure": "procedure",
    "mount": "mount",
    "angle_deg": "angle_deg",
    "direction": "direction",
    "temperature_degC": "temperature_degc",
    "voltage_V": "voltage_v",
    "voltage_sd_V": "voltage_sd_v",
    "samples": "samples",
    "reference_deg": "reference_deg",
    "velocity_deg_s": "velocity_deg_s",
}
"""Column of the table → field of `Observations`, in the order in which they are written."""

_INTEGERS = {"realisation", "direction", "samples"}
_TEXTS = {"procedure", "mount"}
_MOST = 2**53
"""Beyond this a floating-point number no longer counts."""


class TableError(ValueError):
    """A table that cannot be read; the message names file, line and column and says what to do."""


def read_table(path: Path) -> Observations:
    """Read an observation table.

    Rows with NaN, infinity or an overload are set aside and listed. Columns that the format does not know are kept in
    `Observations.extra`.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    text, warnings = _read_text(path)
    header, rows = _split(text, path, _check_header)
    columns = {name: _column(name, index, rows, path) for index, name in enumerate(header)}
    known: dict[str, Any] = {FIELDS[name]: values for name, values in columns.items() if name in FIELDS}
    return set_aside_bad_rows(
        Observations(
            row=np.arange(1, len(rows) + 1),
            extra={name: values for name, values in columns.items() if name not in FIELDS},
            source=str(path),
            warnings=warnings,
            **known,
        )
    )


def read_lines(path: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Header of any table of this format, and number and cells of each of its rows. Raises `TableError`."""
    return _split(_read_text(path)[0], path, _check_names)


def _split(
    text: str, path: Path, check: Callable[[list[str], Path], None]
) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """The header, once it was checked, and what is below it."""
    lines = _records(text, path)
    try:
        _, header = next(lines)
    except StopIteration:
        raise TableError(f"{path}: the file is empty; expected a header line and one row per dwell") from None
    check(header, path)
    rows = list(lines)
    if not rows:
        raise TableError(f"{path}: there is a header but no row; expected one row per dwell")
    return header, rows


def write_table(observations: Observations, path: Path) -> None:
    """Write the usable rows as an observation table, with every digit of every number."""
    known = {name: values for name, field in FIELDS.items() if (values := getattr(observations, field)) is not None}
    columns = {**known, **observations.extra}
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))


def _read_text(path: Path) -> tuple[str, tuple[str, ...]]:
    try:
        raw = read_bounded(path)
    except OSError as error:
        raise TableError(f"{path}: cannot be read ({error.strerror}); check the name and the rights") from error
    if (rows := raw.count(b"\n")) > MOST_ROWS:
        raise TableError(
            f"{path}: holds {rows:,} lines, and at most {MOST_ROWS:,} are read; cut it into several tables"
        )
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise TableError(
            f"{path}, line {line}: not UTF-8 (byte 0x{raw[error.start]:02x}); save the table as UTF-8"
        ) from error
    if text and not text.endswith(("\n", "\r")):
        return text, (f"{path}: the last line has no line end; check that the file is whole",)
    return text, ()


def _records(text: str, path: Path) -> Iterator[tuple[int, list[str]]]:
    """Line number and cells of each record, comments and blank lines left out."""
    width = 0
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.startswith("#"):
            continue
        try:
            cells = [cell.strip() for cell in next(csv.reader([line], strict=True))]
        except csv.Error as error:
            raise TableError(f"{path}, line {number}: {error}; expected plain values between commas") from error
        width = width or len(cells)
        if len(cells) != width:
            raise TableError(
                f"{path}, line {number}: {len(cells)} values where the header has {width} columns; "
                "complete the line or remove it"
            )
        yield number, cells


def _check_names(header: list[str], path: Path) -> None:
    if len(header) == 1 and (other := next((mark for mark in (";", "\t") if mark in header[0]), "")):
        name = {";": "semicolons", "\t": "tabs"}[other]
        raise TableError(f"{path}, line 1: values between {name}; write commas between them and decimal points in them")
    if len(set(header)) != len(header):
        double = next(name for name in header if header.count(name) > 1)
        raise TableError(f"{path}, line 1, column {double}: named twice; rename or remove one")


def _check_header(header: list[str], path: Path) -> None:
    _check_names(header, path)
    if "angle_deg" not in header:
        raise TableError(f"{path}, line 1: column angle_deg is missing{_hint('angle_deg', header)}")
    if "voltage_V" not in header and "reference_deg" not in header:
        raise TableError(f"{path}, line 1: column voltage_V (or reference_deg) is missing{_hint('voltage_V', header)}")


def _hint(wanted: str, header: list[str]) -> str:
    quantity = wanted.split("_")[0]
    near = [name for name in header if quantity in name.lower()]
    return f"; is it {near[0]}? Rename it and check its unit" if near else f"; the columns are {', '.join(header)}"


def _column(name: str, index: int, rows: list[tuple[int, list[str]]], path: Path) -> np.ndarray:
    cells = [cells[index] for _, cells in rows]
    if name in _TEXTS:
        if name == "mount":
            _check_mounts(cells, rows, path)
        return np.array(cells, dtype=np.str_)
    try:
        values = np.array([_number(cell) for cell in cells])
    except ValueError:
        if name not in FIELDS:
            return np.array(cells, dtype=np.str_)
        line, cell = next((line, cells[index]) for line, cells in rows if not _is_number(cells[index]))
        how = "as a whole number" if name in _INTEGERS else "with a decimal point, or nan where there is none"
        raise TableError(f"{path}, line {line}, column {name}: {cell!r} is not a number; write it {how}") from None
    return _integers(name, values, rows, path) if name in _INTEGERS else values


def _integers(name: str, values: np.ndarray, rows: list[tuple[int, list[str]]], path: Path) -> np.ndarray:
    wrong = (
        ~np.isin(values, (-1, 0, 1))
        if name == "direction"
        else ~((values >= 1) & (values <= _MOST) & (values % 1 == 0))
    )
    if wrong.any():
        first = int(np.argmax(wrong))
        expected = "1, -1 or 0" if name == "direction" else "a whole number from 1"
        raise TableError(
            f"{path}, line {rows[first][0]}, column {name}: {values[first]:g} where {expected} is expected"
        )
    return values.astype(np.int64)


def _check_mounts(cells: list[str], rows: list[tuple[int, list[str]]], path: Path) -> None:
    for (line, _), mount in zip(rows, cells, strict=True):
        if mount not in MOUNTS:
            raise TableError(
                f"{path}, line {line}, column mount: {mount!r} is no mount; the mounts are {', '.join(MOUNTS)}"
            )


def _number(cell: str) -> float:
    """A decimal number; Python's own 1_000 is none in a table. Raises `ValueError`."""
    if "_" in cell:
        raise ValueError(cell)
    return float(cell)


def _is_number(cell: str) -> bool:
    try:
        _number(cell)
    except ValueError:
        return False
    return True
