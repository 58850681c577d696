"""Opening a store."""

from pathlib import Path
from typing import TYPE_CHECKING

from tumble.calibrations.records import DATABASE
from tumble.calibrations.records.errors import StoreError
from tumble.procedures.errors import InputError

if TYPE_CHECKING:
    from tumble.calibrations.records.store import Store


def open_store(folder: Path) -> "Store":
    """Open a store for reading. Raises `InputError` where there is none, `StoreError` where it cannot be used."""
    from tumble.calibrations.records.store import Store  # takes half a second, which many a command need not wait for

    try:
        return Store.existing(folder)
    except StoreError as error:
        if (folder / DATABASE).exists():
            raise
        raise InputError(str(error)) from error
