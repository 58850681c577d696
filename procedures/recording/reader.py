"""Reading a recording, whole or cut off."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import orjson

from tumble.messages import Message
from tumble.procedures.events import ConditionAnswered, ReadingAnswered, SamplesAcquired
from tumble.procedures.recording.blocks import join
from tumble.procedures.recording.contents import Closed, Content, Damage, Said, contents, understood
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.header import Header
from tumble.procedures.recording.layouts import layout_of
from tumble.procedures.recording.messages import JOURNAL, Announcement, Entry, from_message
from tumble.procedures.recording.recorded import Recording
from tumble.procedures.recording.schemas import POINT, SAMPLES, TEMPERATURE, positioner_topic, topics
from tumble.procedures.steps import Ask, Dwell, Point

_LARGEST_JOURNAL = 512 * 2**20
"""Bytes of messages, samples left out; a point takes some 400 of them."""
_Kind = TypeVar("_Kind")


def read_recording(path: Path) -> Recording:
    """Read all but the samples of a recording; of one that was cut off, everything before the cut.

    Raises
    ------
    RecordingError
        Where the file cannot be opened, is no recording, lacks a whole header, or has a newer format.
    """
    closed = False
    journal: list[Entry] = []
    damage: dict[str, None] = {}
    for entry in _bounded(path, contents(path, JOURNAL)):
        match entry:
            case Header():
                header, layout = entry, layout_of(path, entry)
            case Said():
                with understood(path):
                    journal.append(from_message(entry.topic, entry.data, layout))
            case Damage(what=what):
                damage[what] = None
            case Closed():
                closed = True
    points = _latest(_only(Point, journal))
    return Recording(
        path=path,
        header=header,
        points=tuple(points[index] for index in sorted(points)),
        steps=tuple(entry for entry in journal if isinstance(entry, Ask | Dwell)),
        answers=tuple(entry for entry in journal if isinstance(entry, ConditionAnswered | ReadingAnswered)),
        events=tuple(entry for entry in journal if isinstance(entry, Announcement)),
        closed=closed,
        damage=tuple(damage),
    )


def read_header(path: Path) -> Header:
    """Read what a recording says of itself, and no further. Raises `RecordingError` as `read_recording`."""
    return next(entry for entry in contents(path, ()) if isinstance(entry, Header))


def leading(recording: Recording) -> Recording:
    """The recording without the points behind the first that is missing: what a run can go on from."""
    if not recording.missing:
        return recording
    first = recording.missing[0]
    return replace(recording, points=tuple(point for point in recording.points if point.index < first))


def _bounded(path: Path, found: Iterator[Content]) -> Iterator[Content]:
    """Pass on what is to be kept in memory, up to a bound that a run of a million points does not reach."""
    size = 0
    for entry in found:
        size += len(entry.data) if isinstance(entry, Said) else 0
        if size > _LARGEST_JOURNAL:
            happened = Message(
                "says more than {most_mib:.0f} MiB of its run, samples left out",
                most_mib=_LARGEST_JOURNAL / 2**20,
            )
            raise RecordingError(path, happened, Message("no run of this program does: leave the file alone"))
        yield entry


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
    """Yield every message as it was recorded, but for what belongs to the take of a point that was not completed.

    Raises
    ------
    RecordingError
        As `read_recording`.
    """
    takes = {point.index: point.take for point in recording.points}
    layout = layout_of(recording.path, recording.header)
    of_points = {SAMPLES, TEMPERATURE, POINT, *map(positioner_topic, layout.positions)}
    for said in contents(recording.path, topics(layout)):
        if isinstance(said, Said) and (said.topic not in of_points or _is_complete(said, takes)):
            yield said


def _is_complete(said: Said, takes: Mapping[int, int]) -> bool:
    """Whether a message belongs to a take of a point that was completed; `takes` are the latest ones."""
    values = orjson.loads(said.data)
    point = int(values["index" if said.topic == POINT else "point"])
    return int(values.get("take", 1)) <= takes.get(point, 0)


def _latest(points: Iterable[Point]) -> dict[int, Point]:
    """Points by number: of several takes the latest, which stands for good once it is recorded."""
    latest: dict[int, Point] = {}
    for point in points:
        if point.index not in latest or point.take > latest[point.index].take:
            latest[point.index] = point
    return latest


def monotonic_s(said: Said) -> float:
    """The stand's monotonic clock when a message was recorded."""
    return float(orjson.loads(said.data)["monotonic_s"])


def _only(kind: type[_Kind], items: Iterable[object]) -> tuple[_Kind, ...]:
    return tuple(item for item in items if isinstance(item, kind))
