"""Records of an MCAP file as they stand in it, up to where it breaks off (MCAP 1.0, "Record Format").

The library's reader is lenient: it skips what it does not know, reads past the end of a record and takes a string that
is cut short. Here every record has to be exactly as long as it says, and none may be longer than a recording's are.
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from typing import IO, Final, Protocol, TypeVar

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.writer import MCAP0_MAGIC

from tumble.messages import Message

LARGEST_RECORD: Final = 32 * 2**20
"""Bytes. A chunk is ended at 1 MiB, and the header of a recording is a few kilobytes."""
UNREADABLE: Final = (McapError, struct.error, zstandard.ZstdError, ValueError, MemoryError, OverflowError)
"""What the library and its decompressor raise on a damaged record; the last two for a damaged length."""

_HEAD: Final = struct.Struct("<BQ")
_Record = TypeVar("_Record", covariant=True)


class BrokenOff(Exception):  # noqa: N818  # no error of anybody: a file may end anywhere
    """No whole record follows."""


@dataclass(frozen=True, kw_only=True)
class Frame:
    """One record, its content not yet looked at."""

    head: bytes
    """Opcode and length."""
    body: bytes
    place: int
    """Where it begins in the file, in bytes."""
    crc_before: int
    """CRC-32 of everything that stands before it in the file."""

    @property
    def opcode(self) -> int:
        """Kind of the record, one of `mcap.opcode.Opcode` if it is known."""
        return self.head[0]


def frames(stream: IO[bytes]) -> Iterator[Frame]:
    """Yield every record, the footer as the last one, behind which the file has to end.

    Raises
    ------
    BrokenOff
        Where the file does not begin or end as an MCAP file does, or the next record is not whole or far too long.
    """
    magic = stream.read(len(MCAP0_MAGIC))
    if magic != MCAP0_MAGIC:
        raise BrokenOff
    crc, opcode, place = zlib.crc32(magic), 0, len(magic)
    while opcode != Opcode.FOOTER:
        head = _exactly(stream, _HEAD.size)
        opcode, length = _HEAD.unpack(head)
        if not opcode or length > LARGEST_RECORD:  # 0 is no record: a file system fills with it what was not written
            raise BrokenOff
        body = _exactly(stream, length)
        yield Frame(head=head, body=body, place=place, crc_before=crc)
        crc, place = zlib.crc32(body, zlib.crc32(head, crc)), place + len(head) + length
    if stream.read(len(MCAP0_MAGIC) + 1) != MCAP0_MAGIC:
        raise BrokenOff


def _exactly(stream: IO[bytes], length: int) -> bytes:
    data = stream.read(length)
    if len(data) != length:
        raise BrokenOff
    return data


class Readable(Protocol[_Record]):
    """A record type of the library."""

    @staticmethod
    def read(stream: ReadDataStream) -> _Record:
        """Read the content of one record."""
        ...


def parsed(kind: Readable[_Record], frame: Frame) -> _Record:
    """Read the content of a record, all of it. Raises one of `UNREADABLE`."""
    stream = ReadDataStream(BytesIO(frame.body))
    record = kind.read(stream)
    if stream.count != len(frame.body):
        raise ValueError(
            Message.counted(
                "a record of {count} byte has content of {stated}",
                "a record of {count} bytes has content of {stated}",
                count=len(frame.body),
                stated=stream.count,
            )
        )
    return record
