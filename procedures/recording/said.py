"""The template and the fields of a message as JSON, which stand beside its English text in a recording.

Whoever reads the recording can so be told in another language what happened. A recording of an earlier version, or of
another program, has the text alone.
"""

import math
import re
from collections.abc import Mapping
from typing import Any, Final

from tumble.messages import Message

_TEMPLATE: Final = re.compile(r"(?:[^{}]|\{\{|\}\}|\{\w+(?:![rs])?(?::[+,]?(?:\.\d)?[A-Za-z]?)?\})*")
"""What a template of this program looks like: nothing in it looks into a field, or makes it wider."""


def said_of(text: str) -> dict[str, Any] | None:
    """Template, plural and fields of a message; None of any other text."""
    if not isinstance(text, Message):
        return None
    fields = {name: _to_json(value) for name, value in text.fields.items()}
    return {"template": text.template, "plural": text.plural, "fields": fields}


def message_of(text: str, said: object) -> str:
    """The message of which `said` was recorded, where it says just `text`; else `text` itself."""
    try:
        message = _from_json(said)
    except (AttributeError, KeyError, TypeError, ValueError):  # it was altered, or of another version
        return text
    return message if isinstance(message, Message) and message == text else text


def _to_json(value: object) -> object:
    if isinstance(value, Message):
        return said_of(value)
    if isinstance(value, int) or (isinstance(value, float) and math.isfinite(value)):
        return value
    return str(value)


def _from_json(value: Any) -> Any:  # noqa: ANN401  # whatever stands in a file
    if not isinstance(value, Mapping):
        return value
    template, plural = value["template"], value["plural"]
    if not _TEMPLATE.fullmatch(template) or not _TEMPLATE.fullmatch(plural):
        raise ValueError(template)
    fields = {name: _from_json(field) for name, field in value["fields"].items()}
    return Message.of_parts(template, plural, fields)
