"""Reading and writing in a store; an older one is read as it is and brought up to date before it is written."""

import secrets
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from sqlalchemy import Connection, Engine, Index, select
from sqlalchemy.schema import CreateIndex, DropIndex

from tumble.calibrations.records.listing import EARLIER_INDEXES, INDEX
from tumble.calibrations.records.migrations.view import show_as_current
from tumble.calibrations.records.schema import STORE, STORE_VERSION

BEGIN = "tumble_begin"
"""Option of a connection: the statement with which its transactions begin."""


@contextmanager
def reading(engine: Engine) -> Iterator[Connection]:
    """One transaction that reads; a store of an older version is seen as one of this version, and not changed."""
    with engine.connect() as connection:
        if (version := stored_version(connection)) != STORE_VERSION:
            show_as_current(connection, version)
        yield connection


@contextmanager
def writing(engine: Engine) -> Iterator[Connection]:
    """One transaction that has the right to write from its beginning on, so that two writers wait for each other.

    A store of an older version is migrated first, and one without the index of `listing` gets it.
    """
    migrate(engine)
    with immediately(engine) as connection:
        _make_listing(connection)
        yield connection


def _make_listing(connection: Connection) -> None:
    connection.execute(CreateIndex(INDEX, if_not_exists=True))
    for name in EARLIER_INDEXES:
        connection.execute(DropIndex(Index(name), if_exists=True))


def migrate(engine: Engine) -> Path | None:
    """Bring an older store to this version in one transaction; None where it is of this version.

    A copy of the old database is written beside it first, and its path returned.
    """
    with engine.connect() as connection:
        if stored_version(connection) == STORE_VERSION:
            return None
    from tumble.calibrations.records.migrations.running import bring_up_to_date  # Alembic, for an old store only

    with immediately(engine) as connection:
        version = stored_version(connection)  # another process may have been faster
        if version == STORE_VERSION:
            return None
        copy = _copy(Path(str(engine.url.database)), version)
        bring_up_to_date(connection, version)
        _make_listing(connection)
    return copy


def _copy(path: Path, version: int) -> Path:
    """Copy the database to `records.sqlite.version-1`, which is never seen unless it is whole."""
    copy = path.with_name(f"{path.name}.version-{version}")
    begun = path.with_name(f".{copy.name}.{secrets.token_hex(4)}")
    try:
        with closing(sqlite3.connect(path)) as source, closing(sqlite3.connect(begun)) as target:
            source.backup(target)
        begun.replace(copy)
    finally:
        begun.unlink(missing_ok=True)
    return copy


def stored_version(connection: Connection) -> int:
    """Version of the tables in a store."""
    return int(connection.execute(select(STORE.c.version)).scalar_one())


@contextmanager
def immediately(engine: Engine) -> Iterator[Connection]:
    """One transaction that has the right to write from its beginning on, in a store of whatever version."""
    with engine.connect().execution_options(**{BEGIN: "BEGIN IMMEDIATE"}) as connection, connection.begin():
        yield connection
