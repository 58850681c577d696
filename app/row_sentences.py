"""The rows of a table in words."""

from collections.abc import Iterator

from tumble.calibrations.core.rows import Rows

_LISTED = 20
"""Rows set aside that are listed."""


def row_lines(rows: Rows) -> Iterator[str]:
    """How many rows were used, and which were set aside, why."""
    yield f"rows: {rows.rows_read} read, {len(rows)} used, {len(rows.set_aside)} set aside"
    for entry in rows.set_aside[:_LISTED]:
        yield f"  row {entry.row}: {entry.reason}"
    if len(rows.set_aside) > _LISTED:
        yield f"  and {len(rows.set_aside) - _LISTED} more; --json lists all"
