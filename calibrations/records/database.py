"""The SQLite database of a store: how it is opened, and what its errors mean."""

import secrets
import sqlite3
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from json import JSONDecodeError
from pathlib import Path

from sqlalchemy import Connection, Engine, NullPool, Table, create_engine, event, insert, inspect, select
from sqlalchemy.engine import URL
from sqlalchemy.exc import DBAPIError

from tumble.calibrations.records.canonical import canonical_text, read_json
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.schema import METADATA, STORE, STORE_VERSION
from tumble.calibrations.records.transactions import BEGIN, immediately
from tumble.messages import Message
from tumble.system_errors import reason

_CAUSES = (
    ("database or disk is full", Message("the disk is full"), Message("free some space and try again")),
    (
        "readonly database",
        Message("the store is not writable"),
        Message("check the rights of file and folder, or choose another store"),
    ),
    (
        "database is locked",
        Message("another program keeps the store locked"),
        Message("close that program and try again"),
    ),
    (
        "unable to open database file",
        Message("the file cannot be opened"),
        Message("check that the folder exists and is writable"),
    ),
    ("not a database", Message("this is not a database"), Message("move the file away, or choose another store")),
    (
        "malformed",
        Message("the database is damaged"),
        Message("restore it from a backup; the raw files are not affected"),
    ),
    (
        "disk I/O error",
        Message("the disk failed to read or write"),
        Message("check disk and connection, and try again"),
    ),
)
"""Part of SQLite's message (sqlite3ErrStr), what happened, what to do."""


def open_database(path: Path, busy_timeout_s: float) -> Engine:
    """Open the database; make one with its tables where there is no file.

    The journal stays SQLite's default, a file beside the database: write-ahead logs do not work on network drives.

    Raises
    ------
    StoreError
        Not possible, not a store (an empty file is none), or a store of a newer version.
    """
    with storage_errors(path):
        if not path.exists():
            _make(path, busy_timeout_s)
        elif not (path.is_file() or path.is_dir()):
            raise StoreError(path, Message("this is no file but a device or a pipe"), Message("choose another store"))
        elif path.is_file() and not path.stat().st_size:
            raise StoreError(
                path, Message("this file is empty and no store"), Message("restore it from a backup, or remove it")
            )
    engine = _engine(path, busy_timeout_s)
    with storage_errors(path), engine.connect() as connection:
        version = _version(connection, path)
    if version > STORE_VERSION:
        raise StoreError(
            path,
            Message(
                "a newer version of the program made this store (version {version}, known up to {known})",
                version=version,
                known=STORE_VERSION,
            ),
            Message("update the program"),
        )
    return engine


def _make(path: Path, busy_timeout_s: float) -> None:
    """Make a database with its tables and then give it its name: nobody ever sees one that is not whole."""
    begun = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    try:
        with immediately(_engine(begun, busy_timeout_s)) as connection:
            METADATA.create_all(connection)
            connection.execute(insert(STORE).values(version=STORE_VERSION))
        with suppress(FileExistsError):  # another process was faster: its store is as good
            _name(begun, path)
    finally:
        begun.unlink(missing_ok=True)


def _name(file: Path, name: Path) -> None:
    """Give a file a name that is not taken. Raises `FileExistsError`."""
    if sys.platform == "win32":
        file.rename(name)  # refuses a name that is taken
        return
    try:
        name.hardlink_to(file)
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        file.rename(name)


@contextmanager
def storage_errors(path: Path) -> Iterator[None]:
    """Turn what database and file system raise into `StoreError`."""
    try:
        yield
    except (DBAPIError, sqlite3.Error) as error:
        raise _store_error(path, str(error.orig if isinstance(error, DBAPIError) else error)) from error
    except JSONDecodeError as error:
        raise StoreError(
            path, Message("a record is damaged ({error})", error=error), Message("restore the file from a backup")
        ) from error
    except OSError as error:
        remedy = Message("check the folder of the store and its rights, or choose another")
        raise StoreError(path, reason(error), remedy) from error


def _store_error(path: Path, message: str) -> StoreError:
    for part, happened, remedy in _CAUSES:
        if part in message:
            return StoreError(path, happened, remedy)
    return StoreError(
        path,
        Message("the database refused ({message})", message=message),
        Message("nothing was written; report this"),
    )


def _engine(path: Path, busy_timeout_s: float) -> Engine:
    engine = create_engine(
        URL.create("sqlite", database=str(path)),
        # The module's own transactions begin too late for DDL; with None, `_begin` does it.
        connect_args={"timeout": busy_timeout_s, "isolation_level": None},
        poolclass=NullPool,
        json_serializer=canonical_text,
        json_deserializer=read_json,
    )
    event.listen(engine, "connect", _on_connect)
    event.listen(engine, "begin", _begin)
    return engine


def _on_connect(connection: sqlite3.Connection, _record: object) -> None:
    connection.execute("PRAGMA foreign_keys = ON")
    connection.execute("PRAGMA synchronous = FULL")
    connection.execute("PRAGMA temp_store = MEMORY")


def _begin(connection: Connection) -> None:
    connection.exec_driver_sql(connection.get_execution_options().get(BEGIN, "BEGIN"))


def _version(connection: Connection, path: Path) -> int:
    """Version of the store. Raises `StoreError` where the database is none."""
    if STORE.name not in inspect(connection).get_table_names():
        raise StoreError(
            path, Message("this database holds something else"), Message("move the file away, or choose another store")
        )
    version: int | None = connection.execute(select(STORE.c.version)).scalar_one_or_none()
    if version is None:
        raise StoreError(
            path, Message("this store does not say its version: it is damaged"), Message("restore it from a backup")
        )
    return version


def deleted_rows(connection: Connection, table: Table) -> int:
    """How many of the row numbers that SQLite gave in turn have no row; the last one leaves no gap."""
    gaps = connection.exec_driver_sql(f"SELECT coalesce(max(rowid), 0) - count(*) FROM main.{table.name}")
    return int(gaps.scalar_one())


def faults(connection: Connection) -> tuple[str, ...]:
    """What `PRAGMA integrity_check` says, but for its `ok` (sqlite.org/pragma.html#pragma_integrity_check)."""
    found = connection.exec_driver_sql("PRAGMA integrity_check").scalars().all()
    return tuple(str(each) for each in found if each != "ok")
