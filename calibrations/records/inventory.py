"""What the tables of a store hold, none of it decoded: for finding what was removed past its triggers."""

from dataclasses import dataclass

from sqlalchemy import Connection, Integer, func, literal_column, select

from tumble.calibrations.records.schema import PARAMETERS, RECORDS


@dataclass(frozen=True, kw_only=True)
class Inventory:
    """Records by name only."""

    ids: frozenset[str]
    """Of every record, superseded ones too."""
    raw_paths: frozenset[str]
    """Of their raw files, as records hold them; those of a record of several files stand in one text."""
    named: frozenset[str]
    """Ids that other rows name."""
    numbers_without_record: int
    """How many of SQLite's own row numbers, given in turn, have no row: it was deleted. The last one leaves no gap."""
    faults: tuple[str, ...]
    """What SQLite finds wrong with the file; empty where it is sound."""

    @property
    def removed(self) -> tuple[str, ...]:
        """Ids of records that other rows name and that are not there."""
        return tuple(sorted(self.named - self.ids))


def inventory(connection: Connection) -> Inventory:
    """Look through the tables of a store."""
    rows = connection.execute(select(RECORDS.c.id, RECORDS.c.supersedes, RECORDS.c.raw_path)).all()
    of_parameters = connection.execute(select(PARAMETERS.c.record_id).distinct()).scalars().all()
    return Inventory(
        ids=frozenset(row.id for row in rows),
        raw_paths=frozenset(row.raw_path for row in rows),
        named=frozenset((*(row.supersedes for row in rows if row.supersedes), *of_parameters)),
        numbers_without_record=_numbers_without_row(connection),
        faults=_faults(connection),
    )


def _numbers_without_row(connection: Connection) -> int:
    rowid = literal_column("rowid", Integer)
    last = connection.execute(
        select(func.coalesce(func.max(rowid), 0) - func.count()).select_from(RECORDS)
    ).scalar_one()
    return int(last)


def _faults(connection: Connection) -> tuple[str, ...]:
    """What `PRAGMA integrity_check` says, but for its `ok` (sqlite.org/pragma.html#pragma_integrity_check)."""
    found = connection.exec_driver_sql("PRAGMA integrity_check").scalars().all()
    return tuple(str(each) for each in found if each != "ok")
