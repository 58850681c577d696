"""The rows of a table in words."""

from collections.abc import Iterator

from tumble.calibrations.core.rows import Rows
from tumble.messages import Message

_LISTED = 20
"""Rows set aside that are listed."""


def row_lines(rows: Rows) -> Iterator[str]:
    """How many rows were used, and which were set aside, why."""
    yield Message(
        "rows: {rows_read} read, {used} used, {set_aside} set aside",
        rows_read=rows.rows_read,
        used=len(rows),
        set_aside=len(rows.set_aside),
    )
    for entry in rows.set_aside[:_LISTED]:
        yield Message("  row {row}: {reason}", row=entry.row, reason=entry.reason)
    if len(rows.set_aside) > _LISTED:
        yield Message("  and {set_aside} more; --json lists all", set_aside=len(rows.set_aside) - _LISTED)
