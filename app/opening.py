"""Opening a store."""

from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.calibrations.records import DATABASE
from tumble.calibrations.records.errors import StoreError
from tumble.messages import Message
from tumble.procedures.errors import InputError

if TYPE_CHECKING:
    from tumble.calibrations.records.store import Store

_OF_RECORDS: Final = "reports/[0-9]*-[0-9]*-*.html"
"""Reports are called by the id of their record."""


def check_not_lost(folder: Path) -> None:
    """Raise `StoreError` where there are reports of records and no database: a new one would begin a second chain."""
    if not (folder / DATABASE).exists() and any(folder.glob(_OF_RECORDS)):
        raise StoreError(
            folder / DATABASE,
            Message("this database is gone, and the reports of its records are here"),
            Message("restore it from a backup, or choose another store"),
        )


def open_store(folder: Path) -> "Store":
    """Open a store for reading. Raises `InputError` where there is none, `StoreError` where it cannot be used."""
    from tumble.calibrations.records.store import Store  # takes half a second, which many a command need not wait for

    try:
        return Store.existing(folder)
    except StoreError as error:
        if (folder / DATABASE).exists():
            raise
        raise InputError(str(error)) from error


def store_to_write(folder: Path) -> "Store":
    """Open a store to add to it; one that is not there is made. Raises `StoreError`, where it is lost too."""
    from tumble.calibrations.records.store import Store

    check_not_lost(folder)
    return Store(folder)
