"""The SQLite database of a store: how it is opened, and what its errors mean."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from json import JSONDecodeError
from pathlib import Path

from sqlalchemy import Connection, Engine, NullPool, create_engine, event, insert, inspect, select
from sqlalchemy.engine import URL
from sqlalchemy.exc import DBAPIError

from calibrations.records.canonical import canonical_text
from calibrations.records.errors import StoreError
from calibrations.records.schema import METADATA, STORE, STORE_VERSION

_CAUSES = (
    ("database or disk is full", "the disk is full", "free some space and try again"),
    ("readonly database", "the store is not writable", "check the rights of file and folder, or choose another store"),
    ("database is locked", "another program keeps the store locked", "close that program and try again"),
    ("unable to open database file", "the file cannot be opened", "check that the folder exists and is writable"),
    ("not a database", "this is not a database", "move the file away, or choose another store"),
    ("malformed", "the database is damaged", "restore it from a backup; the raw files are not affected"),
    ("disk I/O error", "the disk failed to read or write", "check disk and connection, and try again"),
)
"""Part of SQLite's message (sqlite3ErrStr), what happened, what to do."""


def open_database(path: Path, busy_timeout_s: float) -> Engine:
    """Open the database, or make one with its tables, all or nothing.

    The journal stays SQLite's default, a file beside the database: write-ahead logs do not work on network drives.

    Raises
    ------
    StoreError
        Not possible, not a store, or a store of a newer version.
    """
    engine = _engine(path, busy_timeout_s)
    with storage_errors(path):
        with engine.connect() as connection:
            version = _version(connection, path)
        if version is None:
            with writing(engine) as connection:
                version = _version(connection, path) or _create(connection)
    if version > STORE_VERSION:
        raise StoreError(
            path,
            f"a newer version of the program made this store (version {version}, known up to {STORE_VERSION})",
            "update the program",
        )
    return engine


@contextmanager
def writing(engine: Engine) -> Iterator[Connection]:
    """One transaction that has the right to write from its beginning on, so that two writers wait for each other."""
    with engine.connect().execution_options(tumble_begin="BEGIN IMMEDIATE") as connection, connection.begin():
        yield connection


@contextmanager
def storage_errors(path: Path) -> Iterator[None]:
    """Turn what database and file system raise into `StoreError`."""
    try:
        yield
    except (DBAPIError, sqlite3.Error) as error:
        raise _store_error(path, str(error.orig if isinstance(error, DBAPIError) else error)) from error
    except JSONDecodeError as error:
        raise StoreError(path, f"a record is damaged ({error})", "restore the file from a backup") from error
    except OSError as error:
        happened = (error.strerror or str(error)).lower()
        raise StoreError(path, happened, "check the folder of the store and its rights, or choose another") from error


def _store_error(path: Path, message: str) -> StoreError:
    for part, happened, remedy in _CAUSES:
        if part in message:
            return StoreError(path, happened, remedy)
    return StoreError(path, f"the database refused ({message})", "nothing was written; report this")


def _engine(path: Path, busy_timeout_s: float) -> Engine:
    engine = create_engine(
        URL.create("sqlite", database=str(path)),
        # The module's own transactions begin too late for DDL; with None, `_begin` does it.
        connect_args={"timeout": busy_timeout_s, "isolation_level": None},
        poolclass=NullPool,
        json_serializer=canonical_text,
    )
    event.listen(engine, "connect", _on_connect)
    event.listen(engine, "begin", _begin)
    return engine


def _on_connect(connection: sqlite3.Connection, _record: object) -> None:
    connection.execute("PRAGMA foreign_keys = ON")
    connection.execute("PRAGMA synchronous = FULL")


def _begin(connection: Connection) -> None:
    connection.exec_driver_sql(connection.get_execution_options().get("tumble_begin", "BEGIN"))


def _version(connection: Connection, path: Path) -> int | None:
    """Version of the store; None where there are no tables yet."""
    tables = inspect(connection).get_table_names()
    if not tables:
        return None
    if STORE.name not in tables:
        raise StoreError(path, "this database holds something else", "move the file away, or choose another store")
    version: int = connection.execute(select(STORE.c.version)).scalar_one()
    return version


def _create(connection: Connection) -> int:
    METADATA.create_all(connection)
    connection.execute(insert(STORE).values(version=STORE_VERSION))
    return STORE_VERSION
