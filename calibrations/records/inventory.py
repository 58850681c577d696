"""What the tables of a store hold, none of it decoded: for finding what was removed past its triggers."""

from dataclasses import dataclass

from sqlalchemy import Connection, select

from tumble.calibrations.records.chain import Chain, chains
from tumble.calibrations.records.database import deleted_rows, faults
from tumble.calibrations.records.schema import PARAMETERS, RECORDS


@dataclass(frozen=True, kw_only=True)
class Inventory:
    """Records by name only."""

    ids: frozenset[str]
    """Of every record, superseded ones too."""
    raw_paths: frozenset[str]
    """Of their raw files, as records hold them."""
    named: frozenset[str]
    """Ids that other rows name."""
    numbers_without_record: int
    """How many of the database's own row numbers, given in turn, have no row: it was deleted. The last one leaves no
    gap."""
    faults: tuple[str, ...]
    """What the database finds wrong with the file; empty where it is sound."""
    chains: tuple[Chain, ...]
    """Of every writer."""

    @property
    def removed(self) -> tuple[str, ...]:
        """Ids of records that other rows name and that are not there."""
        return tuple(sorted(self.named - self.ids))


def inventory(connection: Connection) -> Inventory:
    """Look through the tables of a store."""
    rows = connection.execute(select(RECORDS.c.id, RECORDS.c.supersedes, RECORDS.c.sources)).all()
    of_parameters = connection.execute(select(PARAMETERS.c.record_id).distinct()).scalars().all()
    return Inventory(
        ids=frozenset(row.id for row in rows),
        raw_paths=frozenset(source["path"] for row in rows for source in row.sources or ()),
        named=frozenset((*(row.supersedes for row in rows if row.supersedes), *of_parameters)),
        numbers_without_record=deleted_rows(connection, RECORDS),
        faults=faults(connection),
        chains=chains(connection),
    )
