"""Reads and writes observation tables: CSV in UTF-8 with one header line, split by `tumble.calibrations.cells`."""

import csv
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.bounded import MOST_ROWS, check_bounded, read_bounded
from tumble.calibrations.cells import Line, TableError, header_cells, is_missing, number, read_cells, shown
from tumble.calibrations.geometry import MOUNTS
from tumble.calibrations.observations import Observations, SetAside
from tumble.calibrations.screening import set_aside_bad_rows

__all__ = ["FIELDS", "TableError", "read_header", "read_lines", "read_table", "write_table"]

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
_UNKNOWN: Final = {"direction": 0}
"""Whole numbers that say that nothing is known: 0 is a direction of its own in the contract."""
_LEFT_OUT: Final = {"temperature_degC", "voltage_sd_V", "direction"}
"""Columns without which a row is still used."""
_MOST = 2**53
"""Beyond this a floating-point number no longer counts."""
_BEGINNING_BYTES: Final = 1 << 16
"""A header is shorter."""
_LISTED = 10
"""Lines that a warning names."""


def read_table(path: Path) -> Observations:
    """Read an observation table.

    Rows with NaN, infinity, an overload or a missing value are set aside and listed; a missing temperature, scatter or
    direction is only warned of. Columns that the format does not know are kept in `Observations.extra`; one that is
    known and empty is left out.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    text, warnings = _read_text(path)
    header, rows = read_cells(text, path)
    _check_header(header, path)
    empty = _empty(header, rows, path)
    columns = {name: _column(name, index, rows, path) for index, name in enumerate(header) if name not in empty}
    known: dict[str, Any] = {FIELDS[name]: values for name, values in columns.items() if name in FIELDS}
    return set_aside_bad_rows(
        Observations(
            row=np.arange(1, len(rows) + 1),
            extra={name: values for name, values in columns.items() if name not in FIELDS},
            source=str(path),
            warnings=(*warnings, *_told(header, empty, rows, path)),
            **known,
        ).without(_without_a_value(header, empty, rows))
    )


def read_lines(path: Path) -> tuple[list[str], list[Line]]:
    """Header of any table of this format, and number and cells of each of its rows. Raises `TableError`."""
    return read_cells(_read_text(path)[0], path)


def read_header(path: Path) -> list[str]:
    """Names of the columns of any table of this format; none where its beginning cannot be read as such."""
    try:
        check_bounded(path)
        with path.open("rb") as file:
            beginning = file.read(_BEGINNING_BYTES)
        return header_cells(beginning.decode("utf-8-sig", "replace"), path)
    except (OSError, TableError):
        return []


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


def _check_header(header: list[str], path: Path) -> None:
    if "angle_deg" not in header:
        raise TableError(f"{path}, line 1: column angle_deg is missing{_hint('angle_deg', header)}")
    if "voltage_V" not in header and "reference_deg" not in header:
        raise TableError(f"{path}, line 1: column voltage_V (or reference_deg) is missing{_hint('voltage_V', header)}")


def _empty(header: list[str], rows: list[Line], path: Path) -> list[str]:
    """Names of the columns that hold no value. Raises `TableError` where nothing is left to analyse."""
    empty = [name for place, name in enumerate(header) if all(is_missing(cells[place]) for _, cells in rows)]
    outputs = {"voltage_V", "reference_deg"} & set(header)
    if "angle_deg" in empty or outputs <= set(empty):
        name = "angle_deg" if "angle_deg" in empty else min(outputs)
        raise TableError(f"{path}, column {name}: holds no value in any row")
    return empty


def _hint(wanted: str, header: list[str]) -> str:
    quantity = wanted.split("_")[0]
    near = [name for name in header if quantity in name.lower()]
    if near:
        return f"; is it {shown(near[0])[1:-1]}? Rename it and check its unit"
    return f"; the columns are {shown(', '.join(header))[1:-1]}"


def _told(header: list[str], empty: list[str], rows: list[Line], path: Path) -> list[str]:
    """Sentences on known columns that are empty, and on rows that are used although a value is missing."""
    told = [f"{path}: column {name} holds no value and is left out" for name in empty if name in FIELDS]
    for name in sorted(_LEFT_OUT & set(header) - set(empty)):
        lines = [line for line, cells in rows if is_missing(cells[header.index(name)])]
        if lines:
            some = ", ".join(map(str, lines[:_LISTED])) + (", …" if len(lines) > _LISTED else "")
            where = f"line {some} has" if len(lines) == 1 else f"{len(lines)} rows (lines {some}) have"
            used = "it is" if len(lines) == 1 else "they are"
            told.append(f"{path}: {where} no {name}; {used} used without it")
    return told


def _without_a_value(header: list[str], empty: list[str], rows: list[Line]) -> tuple[SetAside, ...]:
    """Rows in which a value is missing that every row needs: a whole number, or the mount; once each."""
    needed = [name for name in ("realisation", "samples", "mount") if name in header and name not in empty]
    reasons: dict[int, str] = {}
    for name in needed:
        place = header.index(name)
        for row, (_, cells) in enumerate(rows, start=1):
            if is_missing(cells[place]):
                reasons.setdefault(row, f"{name} is missing")
    return tuple(SetAside(row=row, reason=reason) for row, reason in reasons.items())


def _column(name: str, index: int, rows: list[Line], path: Path) -> NDArray[Any]:
    cells = [cells[index] for _, cells in rows]
    if name in _TEXTS:
        if name == "mount":
            cells = _mounts(cells, rows, path)
        return np.array(cells, dtype=np.str_)
    try:
        values = np.array([number(cell) for cell in cells])
    except ValueError:
        if name not in FIELDS:
            return np.array(cells, dtype=np.str_)
        line, cell = next((line, cells[index]) for line, cells in rows if not _is_number(cells[index]))
        how = "as a whole number" if name in _INTEGERS else "with a decimal point, or nan where there is none"
        raise TableError(f"{path}, line {line}, column {name}: {shown(cell)} is not a number; write it {how}") from None
    return _integers(name, values, rows, path) if name in _INTEGERS else values


def _integers(name: str, values: NDArray[np.float64], rows: list[Line], path: Path) -> NDArray[np.int64]:
    values = np.where(np.isnan(values), _UNKNOWN.get(name, 1), values)
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


def _mounts(cells: list[str], rows: list[Line], path: Path) -> list[str]:
    """The mount of every row, each a known one; face-up where it is missing, and the row is set aside."""
    for (line, _), mount in zip(rows, cells, strict=True):
        if mount not in MOUNTS and not is_missing(mount):
            raise TableError(
                f"{path}, line {line}, column mount: {shown(mount)} is no mount; the mounts are {', '.join(MOUNTS)}"
            )
    return ["face-up" if is_missing(mount) else mount for mount in cells]


def _is_number(cell: str) -> bool:
    try:
        number(cell)
    except ValueError:
        return False
    return True
