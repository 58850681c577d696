"""What an MCAP file holds, up to where it breaks off."""

import struct
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Final, TypeAlias

import zstandard
from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, Footer, McapRecord, Message, Metadata
from mcap.stream_reader import StreamReader

from procedures.recording.errors import RecordingError
from procedures.recording.header import FORMAT_VERSION, Header, header_from_strings
from procedures.recording.schemas import HEADER_METADATA, PROGRAMME_ATTACHMENT


@dataclass(frozen=True, kw_only=True)
class Said:
    """A message: its topic and its JSON."""

    topic: str
    data: bytes
    log_time_ns: int
    """Wall clock when it was recorded, as it stood then."""


class Closed:
    """The file ends as a closed file does, with its footer."""


Content: TypeAlias = Header | Said | Closed

# What the library and its decompressor raise where a file breaks off or is damaged; the last two for a damaged length.
_BROKEN: Final = (McapError, struct.error, zstandard.ZstdError, ValueError, MemoryError, OverflowError)


def contents(path: Path, wanted: Collection[str]) -> Iterator[Content]:
    """Yield the header, then every whole message on the `wanted` topics as they were recorded, then the end.

    Messages in a chunk that is cut or fails its checksum, and all behind it, are left out; `Closed` comes only if the
    file is whole. Holds one chunk at a time.

    Raises
    ------
    RecordingError
        Where the file cannot be opened, holds no whole header, or was written in a newer format.
    """
    programme, begun = b"", False
    topics: dict[int, str] = {}
    for record in _whole_records(path):
        match record:
            case Attachment(name=name, data=data) if name == PROGRAMME_ATTACHMENT:
                programme = data
            case Metadata(name=name, metadata=strings) if name == HEADER_METADATA:
                begun = True
                yield _header(path, strings, programme)
            case Channel(id=channel, topic=topic) if topic in wanted:
                topics[channel] = topic
            case Message(channel_id=channel, data=data, log_time=log_time_ns) if begun and channel in topics:
                yield Said(topic=topics[channel], data=data, log_time_ns=log_time_ns)
            case Footer():
                yield Closed()
    if not begun:
        happened = "is not a recording, or was cut off before its header was complete"
        raise RecordingError(path, happened, "nothing can be recovered from it")


@contextmanager
def understood(path: Path) -> Iterator[None]:
    """Translate what decoding raises on content that this program did not write."""
    try:
        yield
    except (KeyError, TypeError, ValueError, IndexError) as error:
        happened = f"holds something that a recording does not have ({type(error).__name__}: {error})"
        raise RecordingError(path, happened, "it was altered or written by another program") from error


def _header(path: Path, strings: dict[str, str], programme: bytes) -> Header:
    with understood(path):
        header = header_from_strings(strings, programme.decode())
    if header.format_version > FORMAT_VERSION:
        happened = f"has format version {header.format_version}, this program reads up to {FORMAT_VERSION}"
        raise RecordingError(path, happened, f"read it with tumble {header.program_version} or newer")
    return header


def _whole_records(path: Path) -> Iterator[McapRecord]:
    """Records up to the first that is not whole; the footer only if the magic behind it is whole too."""
    try:
        with path.open("rb") as stream:
            yield from _records_before_break(stream, path.stat().st_size)
    except OSError as error:
        raise RecordingError(path, f"cannot be read ({error.strerror or error})", "check the name") from error


def _records_before_break(stream: IO[bytes], size: int) -> Iterator[McapRecord]:
    reader = StreamReader(stream, validate_crcs=True, record_size_limit=size)
    footer = None
    with suppress(*_BROKEN):
        for record in reader.records:
            if isinstance(record, Footer):
                footer = record
            else:
                yield record
        if footer:
            yield footer
