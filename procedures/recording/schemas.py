"""Topics of a recording and the fields of their messages, as JSON Schemas.

Every field has one plain type, because viewers such as Foxglove refuse a list of types. A field that has no value is
left out. NaN and infinities, for which JSON has no number, stand as the strings `"NaN"`, `"Infinity"` and
`"-Infinity"`, as in the JSON mapping of Protocol Buffers.
"""

import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

HEADER_METADATA = "tumble"
"""Name of the metadata record that holds the header."""
PROGRAMME_ATTACHMENT = "programme.toml"

SAMPLES = "/samples"
HEAD = "/head"
TEMPERATURE = "/temperature"
POINT = "/point"
STEP = "/step"
EVENT = "/event"
ANSWER = "/answer"

_POINT_INDEX = ("integer", "number of the point in the run, from 0")
_TIME = ("number", "middle of the dwell, s since the run began, by the stand's clock")
_ANGLE = ("number", "angle as the head reports it, deg; any revolution")
_DIRECTION = ("integer", "sign of the last move of the head; 0 before the first")
_TEMPERATURE = ("number", "mean of the temperature channel, °C")
_MOUNT = ("string", "how the unit sits on the head")
_PROCEDURE = ("string", "what the dwell belongs to")
_SETTING = ("number", "angle to which the operator shall set the head by hand, deg")
_REALISATION = ("integer", "which repeat, from 1")

TOPICS: Final[Mapping[str, Mapping[str, tuple[str, str]]]] = MappingProxyType(
    {
        SAMPLES: {
            "point": _POINT_INDEX,
            "channel": ("integer", "channel of the DAQ, from 0"),
            "channels": ("integer", "number of channels in the block"),
            "first_sample": ("integer", "place in the block of the first sample in this message, from 0"),
            "samples": ("integer", "samples in the whole block, per channel"),
            "time_s": ("number", "first sample of the block, s since the run began, by the stand's clock"),
            "device_time_s": ("number", "first sample of the block by the DAQ's own clock, s"),
            "rate_hz": ("number", "sampling rate, Hz"),
            "temperature_degc": _TEMPERATURE,
            "voltage_v": ("number[]", "samples, V; an overload as the instrument says it"),
        },
        HEAD: {
            "point": _POINT_INDEX,
            "time_s": _TIME,
            "angle_deg": _ANGLE,
            "direction": _DIRECTION,
        },
        TEMPERATURE: {
            "point": _POINT_INDEX,
            "time_s": _TIME,
            "temperature_degc": _TEMPERATURE,
        },
        POINT: {
            "index": _POINT_INDEX,
            "angle_deg": _ANGLE,
            "voltage_v": ("number", "mean output over the dwell, V"),
            "voltage_sd_v": ("number", "standard deviation of the single samples, V"),
            "samples": ("integer", "number of samples in the mean"),
            "time_s": _TIME,
            "direction": _DIRECTION,
            "temperature_degc": _TEMPERATURE,
            "realisation": _REALISATION,
            "procedure": _PROCEDURE,
            "mount": _MOUNT,
            "settled": ("boolean", "false where the output was still moving when the time for settling was over"),
        },
        STEP: {
            "kind": ("string", "mounting or dwell"),
            "mount": _MOUNT,
            "angle_deg": ("number", "head angle to go to, deg"),
            "procedure": _PROCEDURE,
            "realisation": _REALISATION,
        },
        EVENT: {
            "kind": (
                "string",
                "state, identified, verified, resumed, mount requested, reading requested, warning or finished",
            ),
            "state": ("string", "state into which the run went over"),
            "reason": ("string", "why"),
            "message": ("string", "for the reader of the result"),
            "mount": _MOUNT,
            "prompt": ("string", "what the operator was asked"),
            "setting_deg": _SETTING,
            "instrument": ("string", "head or daq"),
            "model": ("string", "what the instrument says it is"),
            "serial": ("string", "serial number that the instrument gives"),
            "firmware": ("string", "version that the instrument gives"),
            "point": _POINT_INDEX,
            "points": ("integer", "number of points that were there when the run was resumed"),
            "voltage_v": ("number", "mean output when the point was taken again to verify it, V"),
            "recorded_v": ("number", "mean output of the point itself, V"),
            "allowed_v": ("number", "by how much the two may differ, V"),
            "at_standstill": ("boolean", "whether the head was seen to stand still at the end"),
        },
        ANSWER: {
            "kind": ("string", "reading for the reading of a head that is set by hand; left out for a mount"),
            "mount": _MOUNT,
            "setting_deg": _SETTING,
            "reading_deg": ("number", "the answer as an angle, deg"),
            "answer": ("string", "the operator's answer, word for word"),
            "confirmed": ("boolean", "whether it was taken for a yes"),
        },
    }
)
"""Fields of every topic: name to type and meaning. Every message has `monotonic_s` besides."""

_MONOTONIC = ("number", "the stand's monotonic clock when the message was recorded, s")


def schema_name(topic: str) -> str:
    """Name of a topic's schema, for example `tumble.Point`."""
    return f"tumble.{topic.removeprefix('/').title()}"


def json_schema(topic: str) -> bytes:
    """JSON Schema of a topic's messages."""
    described = {"monotonic_s": _MONOTONIC, **TOPICS[topic]}
    properties = {name: _property(kind, meaning) for name, (kind, meaning) in described.items()}
    schema = {"title": schema_name(topic), "type": "object", "properties": properties}
    return json.dumps(schema, ensure_ascii=False).encode()


def _property(kind: str, meaning: str) -> dict[str, Any]:
    if kind.endswith("[]"):
        return {"type": "array", "items": {"type": kind.removesuffix("[]")}, "description": meaning}
    return {"type": kind, "description": meaning}
