"""Events as messages of a recording, and back.

A number comes back as exactly the double that was recorded, NaN and infinities included (see `schemas`).
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, fields
from typing import Any, Final, TypeAlias

import numpy as np
import orjson

from tumble.drivers.protocols import VOLTAGE
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    Event,
    FinishReason,
    Identified,
    PointCompleted,
    PointVerified,
    ReadingAnswered,
    ReadingRequested,
    RetakeBegun,
    RunFinished,
    RunResumed,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.layout import Fields, Layout
from tumble.procedures.recording.blocks import split, take_of
from tumble.procedures.recording.said import message_of, said_of
from tumble.procedures.recording.schemas import ANSWER, EVENT, POINT, SAMPLES, STEP, TEMPERATURE, positioner_topic
from tumble.procedures.steps import Ask, Point, Step

Announcement: TypeAlias = (
    StateChanged
    | Identified
    | PointVerified
    | RunResumed
    | RetakeBegun
    | ConditionRequested
    | ReadingRequested
    | WarningRaised
    | RunFinished
)
Entry: TypeAlias = Point | Step | ConditionAnswered | ReadingAnswered | Announcement
"""What the journal of a run consists of, samples left out."""

_RECORDS: Final[Mapping[str, Mapping[str, type[Any]]]] = {
    ANSWER: {"reading": ReadingAnswered},
    EVENT: {
        "state": StateChanged,
        "identified": Identified,
        "verified": PointVerified,
        "resumed": RunResumed,
        "retake": RetakeBegun,
        "reading requested": ReadingRequested,
        "warning": WarningRaised,
        "finished": RunFinished,
    },
}
"""What is recorded as it is, by topic and kind; what goes by the columns of a method is not among it."""
_KINDS: Final = {record: kind for kinds in _RECORDS.values() for kind, record in kinds.items()}
_DWELL: Final = "dwell"
_REQUESTED: Final = " requested"
_OTHER_NAMES: Final = {"now": "voltage_v", "recorded": "recorded_v", "allowed": "allowed_v"}
"""How a recording calls fields that version 0.1 knew for a voltage only."""

JOURNAL: Final = frozenset({POINT, STEP, ANSWER, EVENT})
"""Topics that `from_message` reads; those of positioners and `/temperature` repeat for a viewer what `/point` says."""

_CONVERTERS: Final[Mapping[object, Callable[[Any], object]]] = {
    float: float,
    State: State,
    FinishReason: FinishReason,
}
"""What makes a field's value of its JSON, by the field's type; any other type needs nothing."""


def to_messages(event: Event, layout: Layout) -> Iterator[tuple[str, Fields]]:
    """Topic and fields of the messages that an event becomes; of a point, the row on `/point` comes last."""
    match event:
        case SamplesAcquired():
            yield from ((SAMPLES, part) for part in split(event))
        case PointCompleted(point=point):
            yield from _point_messages(point, layout)
        case StepStarted(step=step):
            yield STEP, _step_fields(step, layout)
        case ConditionRequested():
            yield EVENT, {"kind": event.condition + _REQUESTED, event.condition: event.value, "prompt": event.prompt}
        case ConditionAnswered():
            yield ANSWER, {event.condition: event.value, "answer": event.answer, "confirmed": event.confirmed}
        case ReadingAnswered():
            yield ANSWER, _with_kind(event)
        case _:
            yield EVENT, _with_kind(event)


def from_message(topic: str, data: bytes, layout: Layout) -> Entry:
    """Turn a message on one of the `JOURNAL` topics into what was recorded.

    Raises
    ------
    KeyError, TypeError, ValueError
        Where a field is missing or is not what it should be.
    """
    values = orjson.loads(data)
    kind = values.get("kind", "")
    if topic == POINT:
        return layout.point(values)
    if topic == STEP:
        return layout.dwell(values) if kind == _DWELL else layout.ask(*_condition_set(kind, values, layout))
    if topic == ANSWER and not kind:
        condition = next(iter(layout.conditions.keys() & values.keys()), "")
        asked = {"condition": condition, "value": values[condition]}
        return ConditionAnswered(**asked, answer=values["answer"], confirmed=values["confirmed"])
    if topic == EVENT and (condition := kind.removesuffix(_REQUESTED)) in layout.conditions:
        return ConditionRequested(condition=condition, value=values[condition], prompt=values["prompt"])
    return _as_it_is(_RECORDS[topic][kind], values)


def _step_fields(step: Step, layout: Layout) -> Fields:
    if isinstance(step, Ask):
        return {"kind": layout.conditions[step.condition].step, step.condition: step.value}
    return {"kind": _DWELL, **layout.dwell_fields(step)}


def _condition_set(step: str, values: Mapping[str, Any], layout: Layout) -> tuple[str, str]:
    """Condition and value of a step. Raises `KeyError` where no condition is set by such a one."""
    by_step = {condition.step: name for name, condition in layout.conditions.items()}
    return by_step[step], values[by_step[step]]


def _as_it_is(record: type[Any], values: Mapping[str, Any]) -> Entry:
    if record is PointVerified:
        renamed = {name: values[other] for name, other in _OTHER_NAMES.items()}
        values = {"channel": VOLTAGE, **values, **renamed}
    if "said" in values:
        values = {**values, "message": message_of(values["message"], values["said"])}
    converted = {field.name: _from_json(field.type, values[field.name]) for field in fields(record)}
    entry: Entry = record(**converted)
    return entry


def encode(values: Mapping[str, object]) -> bytes:
    """JSON of a message's fields; those that are None are left out."""
    plain = {name: _to_json(value) for name, value in values.items() if value is not None}
    return orjson.dumps(plain, option=orjson.OPT_SERIALIZE_NUMPY)


def _point_messages(point: Point, layout: Layout) -> Iterator[tuple[str, Fields]]:
    row = layout.point_fields(point)
    at = {"point": point.index, "take": take_of(point.take), "time_s": point.time_s}
    for name, columns in layout.positions.items():
        shown = (columns.position_deg.name, columns.direction.name)
        yield positioner_topic(name), {**at, **{column: row[column] for column in shown}}
    if point.temperature_degc is not None:
        yield TEMPERATURE, {**at, "temperature_degc": point.temperature_degc}
    yield POINT, row


def _with_kind(record: ReadingAnswered | Announcement) -> Fields:
    values = asdict(record)
    if isinstance(record, PointVerified):
        values = {_OTHER_NAMES.get(name, name): value for name, value in values.items()}
    if isinstance(record, WarningRaised | RunFinished):
        values["said"] = said_of(record.message)
    return {"kind": _KINDS[type(record)], **values}


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
