"""The stand records of a folder, in the same database as its calibrations."""

import secrets
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Select, func, insert, inspect, select

from tumble.calibrations.records import DATABASE
from tumble.calibrations.records.canonical import canonical_sha256
from tumble.calibrations.records.database import open_database, storage_errors
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.schema import METADATA, STAND_RECORDS
from tumble.calibrations.records.times import utc_now
from tumble.calibrations.records.transactions import writing
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.record import (
    Contribution,
    StandIdentity,
    StandRecord,
    Status,
    Validity,
    content,
    record_from_content,
)
from tumble.messages import Message


class StandRecords:
    """Stand records of a folder. They can be added and read, not changed and not deleted.

    Every method raises `StoreError` where the storage fails; then nothing was written.

    Parameters
    ----------
    folder
        Made where it does not exist.
    now
        The clock that dates the records, in UTC.
    """

    def __init__(self, folder: Path, now: Callable[[], datetime] = utc_now) -> None:
        self.folder = folder
        self.path = folder / DATABASE
        self._now = now
        with storage_errors(folder):
            folder.mkdir(parents=True, exist_ok=True)
        self._engine = open_database(self.path, busy_timeout_s=30.0)

    def add(
        self,
        *,
        identity: StandIdentity,
        status: Status,
        corrections: Corrections,
        contributions: Sequence[Contribution],
        agreement_p: float | None,
        validity: Validity,
        program_version: str,
    ) -> StandRecord:
        """Record the next version for a stand, in one transaction."""
        with storage_errors(self.path), writing(self._engine) as connection:
            METADATA.create_all(connection, tables=[STAND_RECORDS])  # a store from before there were any has no table
            created_at = self._now()
            record = StandRecord(
                id=f"{created_at:%Y%m%d-%H%M%S}-{secrets.token_hex(3)}",
                version=_last_version(connection, identity) + 1,
                identity=identity,
                status=status,
                corrections=corrections,
                contributions=tuple(contributions),
                agreement_p=agreement_p,
                validity=validity,
                created_at=created_at,
                program_version=program_version,
            )
            record = replace(record, content_sha256=canonical_sha256(content(record)))
            connection.execute(insert(STAND_RECORDS), _row(record))
        return record

    def find(self, identity: StandIdentity | None = None, stand: str | None = None) -> tuple[StandRecord, ...]:
        """Records of one stand identity, or of all stands of a name, or all: each stand's in the order of versions."""
        query = select(STAND_RECORDS).order_by(*_KEY, STAND_RECORDS.c.version)
        if identity is not None:
            query = query.where(*_is(identity))
        return self._records(query if stand is None else query.where(STAND_RECORDS.c.stand == stand))

    def get(self, record_id: str) -> StandRecord:
        """Return the record with this id. Raises `RecordError` where there is none."""
        found = self._records(select(STAND_RECORDS).where(STAND_RECORDS.c.id == record_id))
        if not found:
            raise RecordError(
                Message(
                    "{path}: there is no stand record {record_id}; name the store that holds it",
                    path=self.path,
                    record_id=record_id,
                )
            )
        return found[0]

    def in_force(self, identity: StandIdentity) -> StandRecord | None:
        """The newest version that is in force; None where none is."""
        found = [record for record in self.find(identity) if record.status is Status.IN_FORCE]
        return found[-1] if found else None

    def _records(self, query: Select[Any]) -> tuple[StandRecord, ...]:
        with storage_errors(self.path), self._engine.connect() as connection:
            if not inspect(connection).has_table(STAND_RECORDS.name):
                return ()
            rows = connection.execute(query).mappings()
            return tuple(record_from_content(row["content"], row["content_sha256"]) for row in rows)


_KEY = (STAND_RECORDS.c.stand, STAND_RECORDS.c.head, STAND_RECORDS.c.daq)


def _is(identity: StandIdentity) -> list[Any]:
    values = (identity.stand, identity.head, identity.daq)
    return [column == value for column, value in zip(_KEY, values, strict=True)]


def _last_version(connection: Connection, identity: StandIdentity) -> int:
    query = select(func.coalesce(func.max(STAND_RECORDS.c.version), 0)).where(*_is(identity))
    return int(connection.execute(query).scalar_one())


def _row(record: StandRecord) -> dict[str, Any]:
    return {
        "id": record.id,
        "stand": record.identity.stand,
        "head": record.identity.head,
        "daq": record.identity.daq,
        "version": record.version,
        "status": str(record.status),
        "content": content(record),
        "content_sha256": record.content_sha256,
    }
