"""What has changed since a unit was calibrated before, as far as its store knows."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from tumble.app.opening import open_store
from tumble.calibrations.records.errors import RecordError, StoreError
from tumble.messages import AsWritten, Message

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


def other_lots(folder: Path, record: "Record") -> tuple[str, ...]:
    """A sentence where the last record of the unit that names a lot names another: one of the two is mistaken."""
    from tumble.calibrations.records.changes import LOOKED_AT

    lot, unit = record.provenance.lot, record.provenance.serial_number
    if not lot:
        return ()
    try:
        last = next((each for each in open_store(folder).before(record, LOOKED_AT) if each.provenance.lot), record)
    except (RecordError, StoreError):
        return ()
    if last.provenance.lot == lot:
        return ()
    said = Message(
        "{unit} is of lot {lot} here, but of lot {other_lot} in record {record_id}; see which is right",
        unit=AsWritten(unit),
        lot=AsWritten(lot),
        other_lot=AsWritten(last.provenance.lot),
        record_id=last.id,
    )
    return (said,)
