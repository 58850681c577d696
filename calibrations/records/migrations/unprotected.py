"""Rows that never change, changed by a migration all the same."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

from alembic import op

from tumble.calibrations.records.immutability import sqlite_triggers


@contextmanager
def unprotected(tables: Mapping[str, Sequence[Sequence[str]]]) -> Iterator[None]:
    """Take the triggers of tables away and make them again; `tables` gives the unique keys of each by its name."""
    for table in tables:
        for change in ("update", "delete", "replace"):
            op.execute(f"DROP TRIGGER IF EXISTS {table}_no_{change}")
    yield
    for table, keys in tables.items():
        for statement in sqlite_triggers(table, keys):
            op.execute(statement)
