"""Reading a recording, whole or cut off."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import orjson

from procedures.events import FinishReason, MountAnswered, ReadingAnswered, RunFinished, SamplesAcquired
from procedures.recording.blocks import join
from procedures.recording.contents import Closed, Said, contents, understood
from procedures.recording.header import Header
from procedures.recording.messages import JOURNAL, Announcement, from_message
from procedures.recording.schemas import HEAD, SAMPLES, TEMPERATURE, TOPICS
from procedures.steps import Dwell, Mounting, Point, Step

_OF_POINTS = (SAMPLES, HEAD, TEMPERATURE)
_Kind = TypeVar("_Kind")


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A recording without its samples, up to the end of the file or to where it breaks off."""

    path: Path
    header: Header
    points: tuple[Point, ...]
    """Completed points by index, each once."""
    steps: tuple[Step, ...]
    """Steps that were begun, in order."""
    answers: tuple[MountAnswered | ReadingAnswered, ...]
    events: tuple[Announcement, ...]
    """States, prompts, warnings and the end, in order."""
    closed: bool
    """Whether the file is whole, footer included; false where it was cut off or damaged."""

    @property
    def ending(self) -> RunFinished | None:
        """How the run ended, where it was resumed the last time; None where the recording breaks off before."""
        last = self.events[-1] if self.events else None
        return last if isinstance(last, RunFinished) else None

    @property
    def finished(self) -> bool:
        """Whether the run came to an end, of whatever kind, and said so."""
        return self.ending is not None

    @property
    def complete(self) -> bool:
        """Whether the file is whole and the run carried out its programme to the last step."""
        return self.closed and self.ending is not None and self.ending.reason is FinishReason.COMPLETED


def read_recording(path: Path) -> Recording:
    """Read all but the samples of a recording; of one that was cut off, everything before the cut.

    Raises
    ------
    RecordingError
        Where the file cannot be opened, is no recording, lacks a whole header, or has a newer format.
    """
    found = list(contents(path, JOURNAL))
    with understood(path):
        journal = [from_message(said.topic, said.data) for said in _only(Said, found)]
    # A point stands for good once it is recorded: were it to come twice, the first would count.
    points = {point.index: point for point in reversed(_only(Point, journal))}
    return Recording(
        path=path,
        header=_only(Header, found)[0],
        points=tuple(points[index] for index in sorted(points)),
        steps=tuple(entry for entry in journal if isinstance(entry, Mounting | Dwell)),
        answers=tuple(entry for entry in journal if isinstance(entry, MountAnswered | ReadingAnswered)),
        events=tuple(entry for entry in journal if isinstance(entry, Announcement)),
        closed=bool(_only(Closed, found)),
    )


def iter_samples(path: Path) -> Iterator[SamplesAcquired]:
    """Yield the raw blocks in the order in which they were taken, one in memory at a time.

    Raises
    ------
    RecordingError
        As `read_recording`.
    """
    said = (entry for entry in contents(path, {SAMPLES}) if isinstance(entry, Said))
    with understood(path):
        yield from join(orjson.loads(message.data) for message in said)


def complete_messages(recording: Recording) -> Iterator[Said]:
    """Yield every message as it was recorded, but for what belongs to a point that was not completed.

    Raises
    ------
    RecordingError
        As `read_recording`.
    """
    completed = {point.index for point in recording.points}
    for said in contents(recording.path, TOPICS):
        if isinstance(said, Said) and (said.topic not in _OF_POINTS or orjson.loads(said.data)["point"] in completed):
            yield said


def monotonic_s(said: Said) -> float:
    """The stand's monotonic clock when a message was recorded."""
    return float(orjson.loads(said.data)["monotonic_s"])


def _only(kind: type[_Kind], items: Iterable[object]) -> tuple[_Kind, ...]:
    return tuple(item for item in items if isinstance(item, kind))
