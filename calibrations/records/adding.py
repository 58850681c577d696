"""Records as they are made: a new one, and the one that it may take the place of."""

import secrets
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from sqlalchemy import Connection, select

from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.records.canonical import canonical_sha256, plain
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.export import content, flat
from tumble.calibrations.records.old_formats import provenance_of
from tumble.calibrations.records.record import FORMAT_VERSION, Link, Record
from tumble.calibrations.records.rows import stored_record
from tumble.calibrations.records.schema import RECORDS
from tumble.messages import Message


def new_record(entry: Entry, provenance: Provenance, old: Record | None, link: Link, created_at: datetime) -> Record:
    """The record of an entry, with its hash; `old` is the record that it takes the place of."""
    record = Record(
        id=f"{created_at:%Y%m%d-%H%M%S}-{secrets.token_hex(3)}",
        format_version=FORMAT_VERSION,
        method=entry.method,
        method_version=entry.method_version,
        revision=old.revision + 1 if old else 1,
        supersedes=old.id if old else None,
        created_at=created_at,
        link=link,
        verdict=entry.verdict,
        limits=entry.limits,
        provenance=provenance_of(flat(provenance)),
        models_json=entry.models,
        result=plain(entry.result),
        content_sha256="",
    )
    return replace(record, content_sha256=canonical_sha256(content(record)))


def revisable(connection: Connection, path: Path, record_id: str, entry: Entry, provenance: Provenance) -> Record:
    """The record of an id, which an entry may supersede. Raises `RecordError` where it may not."""
    row = connection.execute(select(RECORDS).where(RECORDS.c.id == record_id)).mappings().one_or_none()
    if row is None:
        raise RecordError(
            Message(
                "{path}: there is no record {record_id} to supersede; give the whole id", path=path, record_id=record_id
            )
        )
    newer = connection.execute(select(RECORDS.c.id).where(RECORDS.c.supersedes == record_id)).scalar_one_or_none()
    if newer is not None:
        raise RecordError(
            Message(
                "{path}: {record_id} is superseded already; supersede {newer}",
                path=path,
                record_id=record_id,
                newer=newer,
            )
        )
    old = stored_record(row, path)
    if set(old.provenance.source_hashes) != set(provenance.source_hashes):
        raise RecordError(
            Message(
                "{path}: {record_id} comes from another raw file; add a record without supersedes",
                path=path,
                record_id=record_id,
            )
        )
    if old.method != entry.method:
        raise RecordError(
            Message(
                "{path}: {record_id} is of method {recorded}, not {method}; add a record without it",
                path=path,
                record_id=record_id,
                recorded=old.method,
                method=entry.method,
            )
        )
    return old
