"""What a chunk holds, unpacked within bounds."""

import zlib
from dataclasses import replace
from typing import Final

import zstandard
from mcap.records import Chunk, McapRecord
from mcap.stream_reader import breakup_chunk

from tumble.messages import Message

LARGEST_CHUNK: Final = 32 * 2**20
"""Bytes of a chunk once it is unpacked; a recording ends each at 1 MiB."""


class TooLargeError(Exception):
    """A chunk that was packed to burst memory: its content is far larger than a recording's is."""


def unpacked(chunk: Chunk) -> list[McapRecord]:
    """Schemas, channels and messages of a chunk.

    Raises
    ------
    TooLargeError
        It says twice, and so not by damage, that it holds more than `LARGEST_CHUNK`. Nothing was unpacked.
    frames.UNREADABLE
        It is damaged.
    """
    data = _decompressed(chunk)
    if len(data) != chunk.uncompressed_size or zlib.crc32(data) != chunk.uncompressed_crc:
        raise ValueError(Message("a chunk fails its checksum"))
    return breakup_chunk(replace(chunk, compression="", data=data))


def _decompressed(chunk: Chunk) -> bytes:
    if not chunk.compression:
        return chunk.data
    if chunk.compression != "zstd":
        raise ValueError(Message("a chunk is compressed by {compression}", compression=chunk.compression))
    size: int = zstandard.get_frame_parameters(chunk.data).content_size
    if size != chunk.uncompressed_size:
        raise ValueError(Message("a chunk says two different sizes"))
    if size > LARGEST_CHUNK:
        raise TooLargeError(
            Message.counted(
                "holds a chunk of {size_mib:.0f} MiB, packed into {count} byte",
                "holds a chunk of {size_mib:.0f} MiB, packed into {count} bytes",
                size_mib=size / 2**20,
                count=len(chunk.data),
            )
        )
    return zstandard.ZstdDecompressor().decompress(chunk.data)
