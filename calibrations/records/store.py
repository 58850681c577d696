"""A folder of calibration records."""

from collections.abc import Callable, Collection, Iterator, Sequence
from datetime import datetime
from itertools import islice
from pathlib import Path
from typing import Any

from sqlalchemy import Column, ColumnElement, Connection, Select, insert, select

from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.records import DATABASE as DATABASE
from tumble.calibrations.records.adding import new_record, revisable
from tumble.calibrations.records.chain import append, next_link, place
from tumble.calibrations.records.database import open_database, storage_errors
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.errors import RecordError, StoreError
from tumble.calibrations.records.findings import names_of
from tumble.calibrations.records.inventory import Inventory, inventory
from tumble.calibrations.records.listing import (
    MEASURED_AT,
    NEWEST_FIRST,
    STANDS,
    earlier,
    names_in,
    newest,
    teach_folding,
    was_found,
)
from tumble.calibrations.records.raw import resolved_path, stored_path
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.rows import parameter_rows, record_row, stored_record
from tumble.calibrations.records.schema import PARAMETERS, RECORDS, STORE_VERSION
from tumble.calibrations.records.times import utc_now, utc_text
from tumble.calibrations.records.transactions import migrate, reading, stored_version, writing
from tumble.calibrations.records.wanted import Wanted
from tumble.messages import Message


class Store:
    """Records in a folder. They can be added and read, not changed and not deleted.

    Every method raises `StoreError` where the storage fails; then nothing was written.

    Parameters
    ----------
    folder
        Made where it does not exist.
    now
        The clock that dates the records, in UTC.
    busy_timeout_s
        How long to wait for another program that writes.
    """

    def __init__(self, folder: Path, now: Callable[[], datetime] = utc_now, busy_timeout_s: float = 30.0) -> None:
        self.folder = folder
        self.path = folder / DATABASE
        self._now = now
        with storage_errors(folder):
            folder.mkdir(parents=True, exist_ok=True)
        self._engine = open_database(self.path, busy_timeout_s)

    @classmethod
    def existing(cls, folder: Path) -> "Store":
        """Open a store to read in it; raise `StoreError` rather than make one."""
        if not (folder / DATABASE).is_file():
            raise StoreError(
                folder,
                Message("there is no {file} in this folder", file=DATABASE),
                Message("name the folder of a store"),
            )
        return cls(folder)

    def migrate(self) -> Path | None:
        """Bring a store of an older version to this one; return the copy of what it was, None where nothing is to do.

        Reading leaves an older store as it is; the first record added migrates it too.
        """
        with storage_errors(self.path):
            return migrate(self._engine)

    def add(self, entry: Entry, provenance: Provenance, supersedes: str | None = None) -> Record:
        """Record a result of any method, in one transaction.

        `supersedes` is the id of the record that this one, another analysis of the same raw files, takes the place of.

        Raises
        ------
        RecordError
            `supersedes` names no record, one that is superseded already, or one of other raw files or another method.
        """
        with storage_errors(self.path), writing(self._engine) as connection:
            old = revisable(connection, self.path, supersedes, entry, provenance) if supersedes else None
            return self._added(connection, entry, provenance, old)

    def revise(self, entry: Entry, provenance: Provenance) -> Record:
        """Record a result in place of what stands of the same raw files, unit and method, if anything does.

        One transaction: of several analyses at the same time each supersedes the one before.
        """
        with storage_errors(self.path), writing(self._engine) as connection:
            unit, hashes = provenance.serial_number, provenance.source_hashes
            return self._added(connection, entry, provenance, self._standing(connection, unit, entry.method, hashes))

    def of_files(self, serial_number: str, method: str, hashes: Collection[str]) -> Record | None:
        """The record of raw files, by their SHA-256, that stands; None where there is none."""
        with storage_errors(self.path), reading(self._engine) as connection:
            return self._standing(connection, serial_number, method, hashes)

    def get(self, id_prefix: str) -> Record:
        """Return the record whose id begins so. Raises `RecordError` where none does, or several do."""
        return self._records(select(RECORDS).where(RECORDS.c.id == self.resolve(id_prefix)))[0]

    def resolve(self, id_prefix: str) -> str:
        """Return the id that begins so, the record itself unread. Raises `RecordError` where none does, or several."""
        query = select(RECORDS.c.id).where(RECORDS.c.id.startswith(id_prefix, autoescape=True))
        with storage_errors(self.path), reading(self._engine) as connection:
            found: Sequence[str] = connection.execute(query.order_by(RECORDS.c.id).limit(5)).scalars().all()
        if not found:
            raise RecordError(
                Message(
                    "{path}: no record has an id that begins with {id_prefix!r}; list the records",
                    path=self.path,
                    id_prefix=id_prefix,
                )
            )
        if len(found) > 1:
            raise RecordError(
                Message(
                    "{path}: {id_prefix!r} fits several records ({ids}); give more of the id",
                    path=self.path,
                    id_prefix=id_prefix,
                    ids=", ".join(found),
                )
            )
        return found[0]

    def find(
        self,
        *,
        serial_number: str | None = None,
        method: str | None = None,
        lot: str | None = None,
        finding: str | None = None,
        programme_name: str | None = None,
        since: datetime | None = None,
        until: datetime | None = None,
        verdict: Outcome | None = None,
    ) -> tuple[Record, ...]:
        """Records that stand (no newer revision) and fit everything given, in the order of measurement.

        Those of the same second are in the order in which they were stored.

        `since` and `until`, both included, need a time zone; `finding` is as in `Wanted`.
        """
        conditions = [
            RECORDS.c.serial_number == serial_number if serial_number is not None else None,
            RECORDS.c.method == method if method is not None else None,
            RECORDS.c.lot == lot if lot is not None else None,
            was_found(finding) if finding is not None else None,
            RECORDS.c.programme_name == programme_name if programme_name is not None else None,
            utc_text(since) <= MEASURED_AT if since else None,
            utc_text(until) >= MEASURED_AT if until else None,
            RECORDS.c.outcome == str(verdict) if verdict else None,
        ]
        given: list[ColumnElement[bool]] = [condition for condition in conditions if condition is not None]
        return self._records(
            select(RECORDS)
            .where(STANDS, *given)
            .order_by(MEASURED_AT, RECORDS.c.created_at, RECORDS.c.sequence, RECORDS.c.id)
        )

    def newest(self, wanted: Wanted, limit: int) -> tuple[Record, ...]:
        """At most so many of the records that stand and are wanted, the newest first; the others are not read."""
        with storage_errors(self.path), reading(self._engine) as connection:
            teach_folding(connection)
            ids: Sequence[str] = connection.execute(newest(wanted, limit)).scalars().all()
            rows = connection.execute(select(RECORDS).where(RECORDS.c.id.in_(ids))).mappings()
            found = {row["id"]: stored_record(row, self.path) for row in rows}
        return tuple(found[each] for each in ids)

    def programmes(self) -> tuple[str, ...]:
        """Names of the programmes of all records, in their order."""
        return self._names_in(RECORDS.c.programme_name)

    def stands(self) -> tuple[str, ...]:
        """Names of the stands of all records, likewise."""
        return self._names_in(RECORDS.c.stand_name)

    def methods(self) -> tuple[str, ...]:
        """Names of the methods of all records, likewise."""
        return self._names_in(RECORDS.c.method)

    def findings(self) -> tuple[str, ...]:
        """Names of everything that was found in a record, in their order; structure without a name is one.

        Empty for a store of an older version, of which every record would have to be read.
        """
        with storage_errors(self.path), reading(self._engine) as connection:
            if stored_version(connection) != STORE_VERSION:
                return ()
            texts = connection.execute(names_in(RECORDS.c.findings)).scalars()
            return tuple(sorted({name for text in texts for name in names_of(text)}))

    def recorded_files(self) -> frozenset[Path]:
        """Where the raw files of all records lie that are in a table still, whether these stand or not."""
        with storage_errors(self.path), reading(self._engine) as connection:
            sources = connection.execute(select(RECORDS.c.sources)).scalars()
            return frozenset(resolved_path(self.folder, each["path"]) for listed in sources for each in listed)

    def standing(self) -> tuple[str, ...]:
        """Ids of the records that stand, in the order of measurement; damaged ones too."""
        query = select(RECORDS.c.id).where(STANDS).order_by(MEASURED_AT, RECORDS.c.id)
        with storage_errors(self.path), reading(self._engine) as connection:
            return tuple(connection.execute(query).scalars())

    def serial_numbers(self) -> tuple[str, ...]:
        """Units of which there are records, by name."""
        return self._names_in(RECORDS.c.serial_number)

    def latest(self, serial_number: str) -> Record | None:
        """Return the record of a unit that was measured last, in its last revision."""
        query = select(RECORDS).where(STANDS, RECORDS.c.serial_number == serial_number)
        found = self._records(query.order_by(MEASURED_AT.desc(), RECORDS.c.id.desc()).limit(1))
        return found[0] if found else None

    def before(self, record: Record, most: int) -> Iterator[Record]:
        """Records of the unit of a record by its method that stand and were measured earlier, the newest first.

        At most so many; each is read when it is asked for. Those that share a raw file with the record are left out:
        a joint result is no further calibration of what it holds. What a simulated stand gave is held against its like
        alone, and so is what a real one gave.
        """
        query = select(RECORDS.c.id, RECORDS.c.sources).where(*earlier(record)).order_by(*NEWEST_FIRST)
        own = set(record.provenance.source_hashes)
        with storage_errors(self.path), reading(self._engine) as connection:
            listed = [(each.id, {source["sha256"] for source in each.sources}) for each in connection.execute(query)]
        records = (self.get(each) for each, hashes in listed if not own & hashes)
        simulated = record.provenance.is_simulated
        return islice((each for each in records if each.provenance.is_simulated == simulated), most)

    def revisions(self, record: Record) -> tuple[Record, ...]:
        """Return the record with those it supersedes, the first one first."""
        chain = [record]
        while (older := chain[0].supersedes) is not None:
            chain.insert(0, self.get(older))
        return tuple(chain)

    def raw_files(self, record: Record) -> tuple[Path, ...]:
        """Where the raw files of a record lie."""
        return tuple(resolved_path(self.folder, source.path) for source in record.provenance.sources)

    def raw_path(self, raw_file: Path) -> str:
        """Return what to put as `path` into a source: relative to the folder where the file lies inside."""
        return stored_path(self.folder, raw_file)

    def rows(self, record: Record) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """What the tables hold of a record, the row of `records` and the rows of `parameters`, to be verified."""
        with storage_errors(self.path), reading(self._engine) as connection:
            row = connection.execute(select(RECORDS).where(RECORDS.c.id == record.id)).mappings().one()
            parameters = connection.execute(select(PARAMETERS).where(PARAMETERS.c.record_id == record.id)).mappings()
            return dict(row), [dict(parameter) for parameter in parameters]

    def inventory(self) -> Inventory:
        """What the tables hold, to be compared with the folder."""
        with storage_errors(self.path), reading(self._engine) as connection:
            return inventory(connection)

    def _added(self, connection: Connection, entry: Entry, provenance: Provenance, old: Record | None) -> Record:
        where = place(self.folder)
        link = next_link(connection, where)
        record = new_record(entry, provenance, old, link, self._now())
        connection.execute(insert(RECORDS), record_row(record))
        if parameters := parameter_rows(record):
            connection.execute(insert(PARAMETERS), parameters)
        append(connection, where, link, record.content_sha256)
        return record

    def _standing(
        self, connection: Connection, serial_number: str, method: str, hashes: Collection[str]
    ) -> Record | None:
        query = select(RECORDS).where(STANDS, RECORDS.c.serial_number == serial_number, RECORDS.c.method == method)
        rows = connection.execute(query.order_by(MEASURED_AT, RECORDS.c.id)).mappings()
        found = [stored_record(row, self.path) for row in rows]
        return next((each for each in reversed(found) if set(each.provenance.source_hashes) == set(hashes)), None)

    def _names_in(self, column: Column[str]) -> tuple[str, ...]:
        with storage_errors(self.path), reading(self._engine) as connection:
            return tuple(connection.execute(names_in(column)).scalars())

    def _records(self, query: Select[Any]) -> tuple[Record, ...]:
        with storage_errors(self.path), reading(self._engine) as connection:
            return tuple(stored_record(row, self.path) for row in connection.execute(query).mappings())
