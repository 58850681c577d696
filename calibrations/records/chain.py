"""Records chained by hash, one chain per writer, so that a record deleted past the triggers is noticed.

Every record holds its number in the chain and the hash of the record before it; the table `chains` holds number and
hash of each writer's last one, which otherwise could be cut off unseen. A writer is one user of one copy of a store:
one who takes a copy along and works offline appends to a chain of his own, and no two copies go on with one chain.

Whoever may write the file and takes the trouble can make all of it anew, hashes and table alike. Against that helps
only a hash noted elsewhere: `tumble records verify` prints that of the last record of every chain.
"""

import getpass
import platform
import secrets
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from tumble.calibrations.records.record import Link
from tumble.calibrations.records.schema import CHAINS, RECORDS
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Chain:
    """The chain of one writer, and what is wrong with it."""

    writer: str
    place: str
    """User, computer and folder; empty where the store has lost it."""
    length: int
    """How many records there must be."""
    last_sha256: str
    faults: tuple[str, ...]
    """In sentences; empty where the chain is whole."""


def place(folder: Path) -> str:
    """Who writes, and where: `anna@lab-1:/data/store`."""
    try:
        user = getpass.getuser()
    except (KeyError, OSError, ImportError):  # a container without a table of users
        user = ""
    return f"{user}@{platform.node()}:{folder.resolve()}"


def next_link(connection: Connection, where: str) -> Link:
    """The link of the record that comes next in the chain of whoever writes at a place."""
    last = connection.execute(select(CHAINS).where(CHAINS.c.place == where).order_by(CHAINS.c.writer)).first()
    if last is None:
        return Link(writer=secrets.token_hex(8), sequence=1, previous_sha256="")
    return Link(writer=last.writer, sequence=last.sequence + 1, previous_sha256=last.content_sha256)


def append(connection: Connection, where: str, link: Link, content_sha256: str) -> None:
    """Note that a record with this link is the last of its chain."""
    last = {"sequence": link.sequence, "content_sha256": content_sha256}
    if link.sequence == 1:
        connection.execute(insert(CHAINS).values(writer=link.writer, place=where, **last))
    else:
        connection.execute(update(CHAINS).where(CHAINS.c.writer == link.writer).values(**last))


def chains(connection: Connection) -> tuple[Chain, ...]:
    """Every chain of a store, looked through from its first record to its last."""
    columns = (RECORDS.c.id, RECORDS.c.writer, RECORDS.c.sequence, RECORDS.c.previous_sha256, RECORDS.c.content_sha256)
    linked = connection.execute(
        select(*columns).where(RECORDS.c.writer.is_not(None)).order_by(RECORDS.c.writer, RECORDS.c.sequence)
    ).all()
    ends = {end.writer: end for end in connection.execute(select(CHAINS))}
    writers = sorted({*ends, *(row.writer for row in linked)})
    return tuple(
        _chain(writer, [row for row in linked if row.writer == writer], ends.get(writer)) for writer in writers
    )


def _chain(writer: str, links: Sequence[Row[*tuple[Any, ...]]], end: Row[*tuple[Any, ...]] | None) -> Chain:
    if end is None:
        lost = Message("The end of the chain of writer {writer} is not in the store: it was removed", writer=writer)
        return Chain(
            writer=writer,
            place="",
            length=len(links),
            last_sha256=links[-1].content_sha256,
            faults=(lost, *_broken(links)),
        )
    present = {link.sequence for link in links}
    missing = [number for number in range(1, end.sequence + 1) if number not in present]
    return Chain(
        writer=writer,
        place=end.place,
        length=end.sequence,
        last_sha256=end.content_sha256,
        faults=(*_deleted(missing, end), *_broken(links), *_beyond(links, end)),
    )


def _deleted(missing: Sequence[int], end: Row[*tuple[Any, ...]]) -> Iterator[str]:
    if missing:
        numbers = ", ".join(map(str, missing[:_LISTED]))
        yield Message.counted(
            "Record {numbers} of {length} is missing from the chain of {place}: deleted",
            "Records {numbers} of {length} are missing from the chain of {place}: deleted",
            count=len(missing),
            numbers=Message("{numbers} and more", numbers=numbers) if len(missing) > _LISTED else numbers,
            length=end.sequence,
            place=end.place,
        )


def _broken(links: Sequence[Row[*tuple[Any, ...]]]) -> Iterator[str]:
    """Records that do not follow from the one before; where that one is missing, it has been said."""
    if links and links[0].sequence == 1 and links[0].previous_sha256:
        yield Message("Record {id} is not the first of its chain: the order was altered", id=links[0].id)
    for before, link in pairwise(links):
        if link.sequence == before.sequence + 1 and link.previous_sha256 != before.content_sha256:
            yield Message(
                "Record {id} does not follow from {before}: one of them, or their order, was altered",
                id=link.id,
                before=before.id,
            )


def _beyond(links: Sequence[Row[*tuple[Any, ...]]], end: Row[*tuple[Any, ...]]) -> Iterator[str]:
    last = links[-1] if links else None
    if last and last.sequence == end.sequence and last.content_sha256 != end.content_sha256:
        yield Message("Record {id} is not the one with which its chain ended: it was altered or replaced", id=last.id)
    if last and last.sequence > end.sequence:
        yield Message(
            "Record {id} lies beyond the end of its chain: the end was altered, or the record put in", id=last.id
        )


_LISTED = 5
"""How many numbers a sentence lists."""
