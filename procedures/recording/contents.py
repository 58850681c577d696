"""What a recording's file holds, up to where it breaks off, and what in it is damaged."""

import stat
import zlib
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TypeAlias

from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, DataEnd, Footer, Metadata, Statistics
from mcap.records import Message as McapMessage

from tumble.messages import Message
from tumble.procedures.recording.chunks import TooLargeError, unpacked
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.frames import UNREADABLE, BrokenOff, Frame, frames, parsed
from tumble.procedures.recording.header import NEWEST_VERSION, Header, header_from_strings, is_intact
from tumble.procedures.recording.schemas import HEADER_METADATA, PROGRAMME_ATTACHMENT
from tumble.system_errors import reason

_SUMMARY_CRC_BYTES: Final = 4
_ATTACHMENT_CRC_BYTES: Final = 4
_WITHOUT_CONTENT: Final = {
    Opcode.HEADER,
    Opcode.SCHEMA,
    Opcode.CHANNEL,
    Opcode.MESSAGE_INDEX,
    Opcode.CHUNK_INDEX,
    Opcode.ATTACHMENT_INDEX,
    Opcode.METADATA_INDEX,
    Opcode.SUMMARY_OFFSET,
}
"""Records from which nothing is read here; schemas and channels are repeated behind the data."""


@dataclass(frozen=True, kw_only=True)
class Said:
    """A message: its topic and its JSON."""

    topic: str
    data: bytes
    log_time_ns: int
    """Wall clock when it was recorded, as it stood then."""


@dataclass(frozen=True, kw_only=True)
class Damage:
    """Something in the file is not as it was written."""

    what: str
    """A clause: `messages 17 to 20 are missing`."""


class Closed:
    """The file ends as a closed file does, and every checksum and count in it is right."""


Content: TypeAlias = Header | Said | Damage | Closed


def contents(path: Path, wanted: Collection[str]) -> Iterator[Content]:
    """Yield the header, then every whole message on the `wanted` topics as they were recorded, then the end.

    What is damaged is left out, and said where it stands. `Closed` comes only if the file is whole. Holds one record
    at a time, none larger than `frames.LARGEST_RECORD`.

    Raises
    ------
    RecordingError
        Where the file cannot be opened, holds no whole header, holds one that was altered, or was written in a newer
        format; where its content would burst memory.
    """
    reading = _Reading(path, wanted)
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise RecordingError(path, Message("is no file"), Message("name a recording"))
        with path.open("rb") as stream, suppress(BrokenOff):
            for frame in frames(stream):
                yield from reading.content(frame)
            yield from reading.end()
    except OSError as error:
        raise RecordingError(
            path, Message("cannot be read ({reason})", reason=reason(error)), Message("check the name")
        ) from error
    if not reading.begun:
        happened = Message("is not a recording, or was cut off before its header was complete")
        raise RecordingError(path, happened, Message("nothing can be recovered from it"))


@contextmanager
def understood(path: Path) -> Iterator[None]:
    """Translate what decoding raises on content that this program did not write."""
    try:
        yield
    except (KeyError, TypeError, ValueError, IndexError) as error:
        happened = Message(
            "holds something that a recording does not have ({kind}: {error})", kind=type(error).__name__, error=error
        )
        raise RecordingError(path, happened, Message("it was altered or written by another program")) from error


class _Reading:
    """Where the reading of one file stands."""

    def __init__(self, path: Path, wanted: Collection[str]) -> None:
        self.begun = False
        self._path = path
        self._wanted = wanted
        self._programme: bytes | None = None
        self._protected = False
        self._topics: dict[int, str] = {}
        self._messages = 0
        self._summary_crc: int | None = None
        self._damaged = False
        self._kinds: dict[int, Callable[[Frame], Iterator[Content]]] = {
            Opcode.ATTACHMENT: self._attachment,
            Opcode.METADATA: self._metadata,
            Opcode.CHUNK: self._chunk,
            Opcode.DATA_END: self._data_end,
            Opcode.STATISTICS: self._statistics,
            Opcode.FOOTER: self._footer,
        }

    def content(self, frame: Frame) -> Iterator[Content]:
        """What a record adds."""
        if self._summary_crc is not None and frame.opcode != Opcode.FOOTER:
            self._summary_crc = zlib.crc32(frame.head + frame.body, self._summary_crc)
        if frame.opcode in self._kinds:
            try:
                yield from self._kinds[frame.opcode](frame)
            except UNREADABLE:
                yield self._damage(Message("the record at byte {place} cannot be read", place=frame.place))
        elif frame.opcode not in _WITHOUT_CONTENT:
            yield self._damage(
                Message("the record at byte {place} is of no kind that a recording has", place=frame.place)
            )

    def end(self) -> Iterator[Content]:
        """What a file adds that ends as a closed file does."""
        if self.begun and not self._damaged:
            yield Closed()

    def _damage(self, what: str) -> Damage:
        self._damaged = True
        return Damage(what=what)

    def _attachment(self, frame: Frame) -> Iterator[Content]:
        attachment = parsed(Attachment, frame)
        crc = int.from_bytes(frame.body[-_ATTACHMENT_CRC_BYTES:], "little")
        if attachment.name == PROGRAMME_ATTACHMENT and self._programme is None:
            self._programme = attachment.data
        if crc != zlib.crc32(frame.body[:-_ATTACHMENT_CRC_BYTES]):
            yield self._damage(Message("the programme in it fails its checksum"))

    def _metadata(self, frame: Frame) -> Iterator[Content]:
        metadata = parsed(Metadata, frame)
        if metadata.name != HEADER_METADATA or self.begun:
            yield self._damage(Message("the record at byte {place} is not one that a recording has", place=frame.place))
            return
        if self._programme is None:
            yield self._damage(Message("the programme in it is missing"))
        header = _header(self._path, metadata.metadata, self._programme or b"")
        self.begun, self._protected = True, header.protected
        yield header

    def _chunk(self, frame: Frame) -> Iterator[Content]:
        if not self.begun:
            return
        try:
            records = unpacked(parsed(Chunk, frame))
        except TooLargeError as error:
            raise RecordingError(
                self._path, str(error), Message("no recording has such a one: leave the file alone")
            ) from error
        for record in records:
            if isinstance(record, Channel):
                self._topics[record.id] = record.topic
            elif isinstance(record, McapMessage):
                yield from self._message(record)

    def _message(self, message: McapMessage) -> Iterator[Content]:
        """A message; they are numbered from 1."""
        if message.sequence != self._messages + 1:
            yield self._damage(_gap(self._messages + 1, message.sequence))
        self._messages = message.sequence
        if message.channel_id not in self._topics:
            self._topics[message.channel_id] = ""
            yield self._damage(
                Message(
                    "it is lost what message {sequence} and others of its kind are about", sequence=message.sequence
                )
            )
        topic = self._topics[message.channel_id]
        if topic in self._wanted:
            yield Said(topic=topic, data=message.data, log_time_ns=message.log_time)

    def _data_end(self, frame: Frame) -> Iterator[Content]:
        stated = parsed(DataEnd, frame).data_section_crc
        self._summary_crc = 0
        if stated != frame.crc_before and (stated or self._protected):
            yield self._damage(Message("its data fail their checksum"))

    def _statistics(self, frame: Frame) -> Iterator[Content]:
        counted = parsed(Statistics, frame).message_count
        if counted != self._messages:
            yield self._damage(
                Message.counted(
                    "{count} message was written to it, and the last that is there is {present}",
                    "{count} messages were written to it, and the last that is there is {present}",
                    count=counted,
                    present=self._messages,
                )
            )

    def _footer(self, frame: Frame) -> Iterator[Content]:
        crc = zlib.crc32(frame.head + frame.body[:-_SUMMARY_CRC_BYTES], self._summary_crc or 0)
        if self._summary_crc is None or parsed(Footer, frame).summary_crc != crc:
            yield self._damage(Message("its index fails its checksum"))


def _gap(expected: int, found: int) -> str:
    if found <= expected:
        return Message("message {found} stands where message {expected} belongs", found=found, expected=expected)
    if found == expected + 1:
        return Message("message {expected} is missing", expected=expected)
    return Message("messages {expected} to {last} are missing", expected=expected, last=found - 1)


def _header(path: Path, strings: dict[str, str], programme: bytes) -> Header:
    with understood(path):
        text = programme.decode()
        header = header_from_strings(strings, text)
    if header.format_version > NEWEST_VERSION:
        happened = Message(
            "has format version {format_version}, this program reads up to {newest}",
            format_version=header.format_version,
            newest=NEWEST_VERSION,
        )
        raise RecordingError(
            path,
            happened,
            Message("read it with tumble {program_version} or newer", program_version=header.program_version),
        )
    if not is_intact(strings, text):
        happened = Message("has a header that was damaged or altered (its SHA-256 differs)")
        raise RecordingError(
            path, happened, Message("serial number, stand and programme stand in it: restore it from a copy")
        )
    return header
