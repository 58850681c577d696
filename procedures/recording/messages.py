"""Events as messages of a recording, and back.

A number comes back as exactly the double that was recorded, NaN and infinities included (see `schemas`).
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, fields
from typing import Any, Final, TypeAlias

import numpy as np
import orjson

from tumble.procedures.events import (
    Event,
    FinishReason,
    Identified,
    MountAnswered,
    MountRequested,
    PointCompleted,
    PointVerified,
    ReadingAnswered,
    ReadingRequested,
    RunFinished,
    RunResumed,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.recording.blocks import Fields, split
from tumble.procedures.recording.schemas import ANSWER, EVENT, HEAD, POINT, SAMPLES, STEP, TEMPERATURE
from tumble.procedures.steps import Dwell, Mounting, Point, Step

Announcement: TypeAlias = (
    StateChanged
    | Identified
    | PointVerified
    | RunResumed
    | MountRequested
    | ReadingRequested
    | WarningRaised
    | RunFinished
)
Entry: TypeAlias = Point | Step | MountAnswered | ReadingAnswered | Announcement
"""What the journal of a run consists of, samples left out."""

_RECORDS: Final[Mapping[str, Mapping[str, type[Entry]]]] = {
    POINT: {"": Point},
    ANSWER: {"": MountAnswered, "reading": ReadingAnswered},
    STEP: {"mounting": Mounting, "dwell": Dwell},
    EVENT: {
        "state": StateChanged,
        "identified": Identified,
        "verified": PointVerified,
        "resumed": RunResumed,
        "mount requested": MountRequested,
        "reading requested": ReadingRequested,
        "warning": WarningRaised,
        "finished": RunFinished,
    },
}
_KINDS: Final = {record: kind for kinds in _RECORDS.values() for kind, record in kinds.items()}

JOURNAL: Final = frozenset(_RECORDS)
"""Topics that `from_message` reads; `/head` and `/temperature` repeat for a viewer what `/point` says."""


_CONVERTERS: Final[Mapping[object, Callable[[Any], object]]] = {
    float: float,
    float | None: float,
    State: State,
    FinishReason: FinishReason,
}
"""What makes a field's value of its JSON, by the field's type; any other type needs nothing."""


def to_messages(event: Event) -> Iterator[tuple[str, Fields]]:
    """Topic and fields of the messages that an event becomes; of a point, the row on `/point` comes last."""
    match event:
        case SamplesAcquired():
            yield from ((SAMPLES, part) for part in split(event))
        case PointCompleted(point=point):
            yield from _point_messages(point)
        case StepStarted(step=step):
            yield STEP, _with_kind(step)
        case MountAnswered():
            yield ANSWER, asdict(event)
        case ReadingAnswered():
            yield ANSWER, _with_kind(event)
        case _:
            yield EVENT, _with_kind(event)


def from_message(topic: str, data: bytes) -> Entry:
    """Turn a message on one of the `JOURNAL` topics into what was recorded.

    Raises
    ------
    KeyError, TypeError, ValueError
        Where a field is missing or is not what it should be.
    """
    values = orjson.loads(data)
    record = _RECORDS[topic][values.get("kind", "")]
    given = {"temperature_degc": None, **values}
    converted: dict[str, Any] = {field.name: _from_json(field.type, given[field.name]) for field in fields(record)}
    return record(**converted)


def encode(values: Mapping[str, object]) -> bytes:
    """JSON of a message's fields; those that are None are left out."""
    plain = {name: _to_json(value) for name, value in values.items() if value is not None}
    return orjson.dumps(plain, option=orjson.OPT_SERIALIZE_NUMPY)


def _point_messages(point: Point) -> Iterator[tuple[str, Fields]]:
    at = {"point": point.index, "time_s": point.time_s}
    yield HEAD, {**at, "angle_deg": point.angle_deg, "direction": point.direction}
    if point.temperature_degc is not None:
        yield TEMPERATURE, {**at, "temperature_degc": point.temperature_degc}
    yield POINT, asdict(point)


def _with_kind(record: Step | ReadingAnswered | Announcement) -> Fields:
    return {"kind": _KINDS[type(record)], **asdict(record)}


def _to_json(value: object) -> object:
    match value:
        case np.ndarray():
            return value if np.isfinite(value).all() else [_to_json(number) for number in value.tolist()]
        case float() if math.isnan(value):
            return "NaN"
        case float() if math.isinf(value):
            return "Infinity" if value > 0 else "-Infinity"
        case str():  # a terminal may pass on bytes that are no character; JSON cannot hold them
            return value.encode("utf-8", "backslashreplace").decode("utf-8")
        case _:
            return value


def _from_json(wanted: object, value: object) -> object:
    convert = _CONVERTERS.get(wanted)
    return value if convert is None or value is None else convert(value)
