"""What has changed since a unit was calibrated before, as far as its store knows."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from tumble.app.opening import open_store
from tumble.calibrations.records.errors import RecordError, StoreError

if TYPE_CHECKING:
    from tumble.calibrations.records.changes import Change
    from tumble.calibrations.records.record import Record


def changes_since(folder: Path, record: "Record") -> "Mapping[str, Change]":
    """How far each value of a record has moved, by name; nothing where what was recorded before cannot be read.

    A damaged record is no reason to leave a result unreported: `tumble records verify` tells of it.
    """
    from tumble.calibrations.records.changes import LOOKED_AT, changes  # scipy takes time

    try:
        return changes(record, open_store(folder).before(record, LOOKED_AT))
    except (RecordError, StoreError):
        return {}
