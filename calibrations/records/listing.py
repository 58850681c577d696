"""Finding records without reading them: a store may hold a hundred thousand, and a screen shows a few.

The index holds everything that is looked for, in the order of measurement, so that a search reads no record but those
that it shows. A store that has none, made by an earlier version of the program, gets it with the next record.
"""

from datetime import datetime
from sqlite3 import Connection as Database
from typing import Any, Final
from unicodedata import normalize

from sqlalchemy import Column, ColumnElement, Connection, Index, Select, func, select

from tumble.calibrations.records.findings import line_of
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.schema import RECORDS
from tumble.calibrations.records.times import utc_text
from tumble.calibrations.records.wanted import Wanted

NEWER: Final = RECORDS.alias("newer")
STANDS: Final = ~select(NEWER.c.supersedes).where(NEWER.c.supersedes == RECORDS.c.id).correlate(RECORDS).exists()
MEASURED_AT: Final = func.coalesce(RECORDS.c.measured_at, RECORDS.c.created_at)
"""Start of the run, or when the record was made where the source does not say."""
NEWEST_FIRST: Final = (MEASURED_AT.desc(), RECORDS.c.created_at.desc(), RECORDS.c.sequence.desc(), RECORDS.c.id.desc())
INDEX: Final = Index(
    "ix_records_found",
    MEASURED_AT,
    RECORDS.c.created_at,
    RECORDS.c.sequence,
    RECORDS.c.id,
    RECORDS.c.serial_number,
    RECORDS.c.programme_name,
    RECORDS.c.stand_name,
    RECORDS.c.method,
    RECORDS.c.outcome,
    RECORDS.c.lot,
    RECORDS.c.findings,
    RECORDS.c.measured_at,  # without it SQLite takes the expression for one that needs the record
)
EARLIER_INDEXES: Final = ("ix_records_listing", "ix_records_search")
"""What was in its place: without stand and method, then without lot and findings."""


def newest(wanted: Wanted, limit: int) -> Select[Any]:
    """The ids of the newest records that stand and are wanted, the newest first."""
    return select(RECORDS.c.id).where(*_conditions(wanted), STANDS).order_by(*NEWEST_FIRST).limit(limit)


def earlier(record: Record) -> tuple[ColumnElement[bool], ...]:
    """What is true of the records of a unit by one method that stand and were measured before another one."""
    moment = record.provenance.measured_at
    measured = utc_text(datetime.fromisoformat(moment) if moment else record.created_at)
    return (
        RECORDS.c.serial_number == record.provenance.serial_number,
        RECORDS.c.method == record.method,
        measured > MEASURED_AT,
        STANDS,
    )


def was_found(name: str) -> ColumnElement[bool]:
    """Whether something was found in a record; an empty name: nothing was."""
    return func.instr(RECORDS.c.findings, line_of(name)) > 0 if name else RECORDS.c.findings == ""


def names_in(column: Column[str]) -> Select[Any]:
    """Everything that a column of all records says, once and in order; a record that says nothing is left out."""
    return select(column).where(column != "").distinct().order_by(column)


def teach_folding(connection: Connection) -> None:
    """Have a connection compare letters of any script without regard to capitals, and to how they are put together."""
    database: Database = connection.connection.driver_connection  # type: ignore[assignment]
    database.create_function("folded", 1, _folded, deterministic=True)


def _folded(text: str | None) -> str:
    """A letter and its accent are one character or two, which nobody sees."""
    return normalize("NFC", text or "").casefold()


def _conditions(wanted: Wanted) -> list[ColumnElement[bool]]:
    unit, lot = wanted.part_of_serial_number, wanted.part_of_lot
    conditions = [
        _contains(RECORDS.c.serial_number, unit) if unit else None,
        _contains(RECORDS.c.lot, lot) if lot else None,
        RECORDS.c.programme_name == wanted.programme_name if wanted.programme_name else None,
        RECORDS.c.stand_name == wanted.stand_name if wanted.stand_name else None,
        RECORDS.c.method == wanted.method if wanted.method else None,
        RECORDS.c.outcome == str(wanted.verdict) if wanted.verdict else None,
        None if wanted.finding is None else was_found(wanted.finding),
        utc_text(wanted.since) <= MEASURED_AT if wanted.since else None,
        utc_text(wanted.until) >= MEASURED_AT if wanted.until else None,
    ]
    return [condition for condition in conditions if condition is not None]


def _contains(column: Column[str], part: str) -> ColumnElement[bool]:
    """LIKE of SQLite folds the letters of ASCII, and those alone, faster than a function does.

    The function is called for every unit or lot once, and not for each of its records. The index is read in its order
    all the same: by the units that fit, which may be all of them, SQLite would read every record.
    """
    if part.isascii():
        return column.contains(part, autoescape=True)
    names = select(column.label("name")).distinct().cte(f"every_{column.name}").prefix_with("MATERIALIZED")
    fitting = func.instr(func.folded(names.c.name), _folded(part)) > 0
    in_order_of_listing = column + ""
    return in_order_of_listing.in_(select(names.c.name).where(fitting))
