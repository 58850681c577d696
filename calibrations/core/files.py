"""Text files of rows: opened, bounded, and split into lines and cells."""

from pathlib import Path
from typing import Final

from tumble.calibrations.core.bounded import MOST_ROWS, check_bounded, read_bounded
from tumble.calibrations.core.cells import Line, TableError, header_cells, read_cells
from tumble.messages import Message
from tumble.system_errors import reason

_BEGINNING_BYTES: Final = 1 << 16
"""A header is shorter."""


def read_lines(path: Path) -> tuple[list[str], list[Line]]:
    """Header of any table of this format, and number and cells of each of its rows. Raises `TableError`."""
    return read_cells(read_text(path)[0], path)


def read_header(path: Path) -> list[str]:
    """Names of the columns of any table of this format; none where its beginning cannot be read as such."""
    try:
        check_bounded(path)
        with path.open("rb") as file:
            beginning = file.read(_BEGINNING_BYTES)
        return header_cells(beginning.decode("utf-8-sig", "replace"), path)
    except (OSError, TableError):
        return []


def read_text(path: Path) -> tuple[str, tuple[str, ...]]:
    """Text of a file, and warnings about its end. Raises `TableError`: unreadable, too large or not UTF-8."""
    try:
        raw = read_bounded(path)
    except OSError as error:
        raise TableError(
            Message("{path}: cannot be read ({reason}); check the name and the rights", path=path, reason=reason(error))
        ) from error
    if (rows := raw.count(b"\n")) > MOST_ROWS:
        raise TableError(
            Message(
                "{path}: holds {lines:,} lines, and at most {most:,} are read; cut it into several tables",
                path=path,
                lines=rows,
                most=MOST_ROWS,
            )
        )
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise TableError(
            Message(
                "{path}, line {line}: not UTF-8 (byte 0x{byte:02x}); save the table as UTF-8",
                path=path,
                line=line,
                byte=raw[error.start],
            )
        ) from error
    if text and not text.endswith(("\n", "\r")):
        return text, (Message("{path}: the last line has no line end; check that the file is whole", path=path),)
    return text, ()
