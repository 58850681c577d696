"""Topics of a recording and the fields of their messages, as JSON Schemas.

Every field has one plain type, because viewers such as Foxglove refuse a list of types. A field that has no value is
left out. NaN and infinities, for which JSON has no number, stand as the strings `"NaN"`, `"Infinity"` and
`"-Infinity"`, as in the JSON mapping of Protocol Buffers.
"""

import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

from tumble.procedures.layout import POINT_INDEX, PROCEDURE, REALISATION, TAKE, TEMPERATURE_MEAN, TIME, Layout

HEADER_METADATA = "tumble"
"""Name of the metadata record that holds the header."""
PROGRAMME_ATTACHMENT = "programme.toml"

SAMPLES = "/samples"
TEMPERATURE = "/temperature"
POINT = "/point"
STEP = "/step"
EVENT = "/event"
ANSWER = "/answer"

_SETTING = ("number", "angle to which the operator shall set a positioner by hand, deg")

_SAMPLES_FIELDS: Final[Mapping[str, tuple[str, str]]] = MappingProxyType(
    {
        "point": POINT_INDEX,
        "take": TAKE,
        "channel": ("integer", "channel of the sampler, from 0"),
        "channels": ("integer", "number of channels in the block"),
        "first_sample": ("integer", "place in the block of the first sample in this message, from 0"),
        "samples": ("integer", "samples in the whole block, per channel"),
        "time_s": ("number", "first sample of the block, s since the run began, by the stand's clock"),
        "device_time_s": ("number", "first sample of the block by the sampler's own clock, s"),
        "rate_hz": ("number", "sampling rate, Hz"),
        "temperature_degc": TEMPERATURE_MEAN,
        "voltage_v": ("number[]", "samples, V; an overload as the instrument says it"),
        "name": ("string", "name of the channel, where it is another than voltage_v"),
        "values": ("number[]", "samples of a channel that has a name, in its unit"),
    }
)
_EVENT_FIELDS: Final[Mapping[str, tuple[str, str]]] = MappingProxyType(
    {
        "kind": (
            "string",
            "state, identified, verified, resumed, retake, reading requested, warning or finished; or what is "
            "requested",
        ),
        "state": ("string", "state into which the run went over"),
        "reason": ("string", "why"),
        "message": ("string", "for the reader of the result"),
        "said": ("object", "template, plural and fields of the message, by which it is put into another language"),
        "prompt": ("string", "what the operator was asked"),
        "setting_deg": _SETTING,
        "instrument": ("string", "name of the instrument at the stand"),
        "model": ("string", "what the instrument says it is"),
        "serial": ("string", "serial number that the instrument gives"),
        "firmware": ("string", "version that the instrument gives"),
        "point": POINT_INDEX,
        "points": ("integer", "number of points that were there when the run was resumed"),
        "channel": ("string", "name of the channel that was compared"),
        "voltage_v": ("number", "mean when the point was taken again to verify it, in the unit of the channel"),
        "recorded_v": ("number", "mean of the point itself"),
        "allowed_v": ("number", "by how much the two may differ"),
        "at_standstill": ("boolean", "whether everything was seen to stand still at the end"),
    }
)
_ANSWER_FIELDS: Final[Mapping[str, tuple[str, str]]] = MappingProxyType(
    {
        "kind": ("string", "reading for the reading of a positioner that is set by hand; left out for a condition"),
        "setting_deg": _SETTING,
        "reading_deg": ("number", "the answer as an angle, deg"),
        "answer": ("string", "the operator's answer, word for word"),
        "confirmed": ("boolean", "whether it was taken for a yes"),
    }
)


def positioner_topic(name: str) -> str:
    """Topic on which a viewer sees where a positioner stood: `/head`."""
    return f"/{name}"


def topics(layout: Layout) -> dict[str, dict[str, tuple[str, str]]]:
    """Fields of every topic of a method: name to type and meaning. Every message has `monotonic_s` besides."""
    conditions = layout.described_conditions()
    at = {"point": POINT_INDEX, "take": TAKE, "time_s": TIME}
    positioners = {positioner_topic(name): at | columns.described() for name, columns in layout.positions.items()}
    settings = {columns.position_deg.name: ("number", "where to go, deg") for columns in layout.positions.values()}
    step = {"kind": ("string", "dwell, or what is asked for"), **conditions, **settings}
    return {
        SAMPLES: dict(_SAMPLES_FIELDS),
        **positioners,
        TEMPERATURE: at | {"temperature_degc": TEMPERATURE_MEAN},
        POINT: layout.described(),
        STEP: step | {"procedure": PROCEDURE, "realisation": REALISATION},
        EVENT: dict(_EVENT_FIELDS) | conditions,
        ANSWER: dict(_ANSWER_FIELDS) | conditions,
    }


_MONOTONIC = ("number", "the stand's monotonic clock when the message was recorded, s")


def schema_name(topic: str) -> str:
    """Name of a topic's schema, for example `tumble.Point`."""
    return f"tumble.{topic.removeprefix('/').title()}"


def json_schema(topic: str, layout: Layout) -> bytes:
    """JSON Schema of a topic's messages."""
    described = {"monotonic_s": _MONOTONIC, **topics(layout)[topic]}
    properties = {name: _property(kind, meaning) for name, (kind, meaning) in described.items()}
    schema = {"title": schema_name(topic), "type": "object", "properties": properties}
    return json.dumps(schema, ensure_ascii=False).encode()


def _property(kind: str, meaning: str) -> dict[str, Any]:
    if kind.endswith("[]"):
        return {"type": "array", "items": {"type": kind.removesuffix("[]")}, "description": meaning}
    return {"type": kind, "description": meaning}
