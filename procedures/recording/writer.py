"""Writing a recording while a run goes on."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path
from types import TracebackType
from typing import Final, Self

from mcap.writer import LIBRARY_IDENTIFIER, Writer

from tumble.drivers.clock import Clock
from tumble.messages import Message
from tumble.procedures.events import ConditionAnswered, Event, PointCompleted, ReadingAnswered, RunFinished
from tumble.procedures.recording.contents import Said
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.file import JournalFile, synchronise_folder
from tumble.procedures.recording.header import Header, header_to_strings
from tumble.procedures.recording.layouts import layout_of
from tumble.procedures.recording.messages import encode, to_messages
from tumble.procedures.recording.schemas import HEADER_METADATA, PROGRAMME_ATTACHMENT, json_schema, schema_name
from tumble.system_errors import reason

_DURABLE: Final = (PointCompleted, ConditionAnswered, ReadingAnswered, RunFinished)


class Recorder:
    """The journal of a run, an MCAP file; a context manager that closes it.

    When `record` returns from a completed point, an operator's answer or the end of the run, that is on the disk, and
    everything before it too: the chunk is ended, written, and synchronised. A killed process loses nothing that was
    completed, and a file cut anywhere yields the points before the cut.

    Messages carry the wall clock as it stood, which goes back where somebody sets that clock back; the order in the
    file is the order of events, and messages are numbered from 1. Their field `monotonic_s` never goes back.

    Parameters
    ----------
    path
        File to create; an existing one is never overwritten.
    header
        What the recording says of itself.
    clock
        The stand's clock.
    before
        What another recording of the same run says already; it is on the disk when the constructor returns.
    elsewhen_s
        Added to the stand's monotonic clock, which may have begun anew since.

    Raises
    ------
    RecordingError
        From the constructor, `record` and `close`, where the file exists or cannot be written (full disk, no
        permission). What is on the disk stays readable, and the recorder is closed.
    """

    def __init__(
        self, path: Path, header: Header, clock: Clock, before: Iterable[Said] = (), elsewhen_s: float = 0.0
    ) -> None:
        self.path = path
        self._clock = clock
        self._layout = layout_of(path, header)
        self._elsewhen_s = elsewhen_s
        self._sequence = count(1)
        try:
            self._stream = JournalFile(path)
        except FileExistsError as error:
            raise RecordingError(
                path, Message("exists already"), Message("recordings are not overwritten: choose another name")
            ) from error
        except OSError as error:
            raise _storage_error(path, error) from error
        self._writer = Writer(self._stream, enable_data_crcs=True)  # type: ignore[arg-type]  # it wants no more than there is
        self._channels: dict[str, int] = {}
        with self._storage():
            self._begin(header)
            for said in before:
                self._append(said.topic, said.log_time_ns, said.data)
            self._make_durable()
            synchronise_folder(path.parent)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def record(self, event: Event) -> str | None:
        """Append an event; what a run must not lose is on the disk when this returns. Raises `RecordingError`.

        Returns a sentence where the file had been removed and was put back.
        """
        if self._stream.closed:
            raise RecordingError(self.path, Message("is closed already"), Message("start another recording"))
        wall_ns, monotonic_s = self._clock.wall_ns(), self._clock.monotonic_s() + self._elsewhen_s
        with self._storage():
            for topic, fields in to_messages(event, self._layout):
                self._append(topic, wall_ns, encode({"monotonic_s": monotonic_s, **fields}))
            put_back = isinstance(event, _DURABLE) and self._make_durable()
        if put_back:
            return Message(
                "{path}: was removed while it was written, and was put back; leave it there until the run ends",
                path=self.path,
            )
        return None

    def close(self) -> None:
        """Write the index and the footer, and close the file; a second call does nothing. Raises `RecordingError`."""
        if self._stream.closed:
            return
        with self._storage():
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._make_durable()
            self._stream.close()

    def _begin(self, header: Header) -> None:
        self._writer.start(library=f"tumble {header.program_version}, {LIBRARY_IDENTIFIER}")
        programme = header.programme_text.encode()
        started_ns = header.started_wall_ns
        self._writer.add_attachment(started_ns, started_ns, PROGRAMME_ATTACHMENT, "application/toml", programme)
        self._writer.add_metadata(HEADER_METADATA, header_to_strings(header))

    def _append(self, topic: str, wall_ns: int, data: bytes) -> None:
        self._writer.add_message(self._channel(topic), wall_ns, data, wall_ns, next(self._sequence))

    def _channel(self, topic: str) -> int:
        """Channel of a topic, which is announced in the file before its first message."""
        if topic not in self._channels:
            schema: int = self._writer.register_schema(
                schema_name(topic), "jsonschema", json_schema(topic, self._layout)
            )
            self._channels[topic] = self._writer.register_channel(topic, "json", schema)
        return self._channels[topic]

    def _make_durable(self) -> bool:
        """Have everything on the disk; true where the file had to be put back."""
        self._writer.flush()  # type: ignore[no-untyped-call]
        return self._stream.make_durable()

    @contextmanager
    def _storage(self) -> Iterator[None]:
        """Close the file as it is, and say so, where the disk fails: nothing may follow half a chunk."""
        try:
            yield
        except OSError as error:
            with suppress(OSError):
                self._stream.close()
            raise _storage_error(self.path, error) from error


def _storage_error(path: Path, error: OSError) -> RecordingError:
    happened = Message("cannot be written ({reason})", reason=reason(error))
    return RecordingError(path, happened, Message("make sure that the folder exists, is writable and has room"))
