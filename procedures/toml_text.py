"""TOML text into data, whatever the text holds: refused with its line before the parser meets what it cannot take."""

import re
import tomllib
from collections.abc import Iterator
from typing import Any, Final

from tumble.messages import Message
from tumble.procedures.errors import InputError

BYTE_ORDER_MARK: Final = "\ufeff"
"""Some editors put it in front of UTF-8; it says nothing there."""
MOST_NESTED: Final = 32
"""Brackets within brackets, or parts of a dotted key."""
LONGEST_NUMBER: Final = 64
"""Characters; a double has 17 digits."""

_TOKEN: Final = re.compile(
    r"""
    (?P<text>\"{3}(?:\\.|[^\\])*?\"{3,5} | '{3}.*?'{3,5} | "(?:\\.|[^"\\\n])*" | '[^'\n]*')
    | (?P<comment>\#[^\n]*)
    | (?P<opening>[\[{]) | (?P<closing>[\]}])
    | (?P<number>[+-]?[0-9][A-Za-z0-9_+.\-]*) | (?P<dot>\.) | (?P<end>[\n=,])
    | [A-Za-z_-][A-Za-z0-9_-]*
    """,
    re.VERBOSE | re.DOTALL,
)
_PLACE: Final = re.compile(r" \(at (?:line (\d+), column \d+|end of document)\)$")


def read_toml(text: str, source: str) -> dict[str, Any]:
    """Data of TOML text; messages call it `source`.

    Raises
    ------
    InputError
        It is no TOML, or nests or counts beyond what any of these files needs: file and line.
    """
    content = without_mark(text)
    for position, happened in _beyond_measure(content):
        line = content.count("\n", 0, position) + 1
        raise InputError(
            Message("{source}, line {line}: {happened}; correct it", source=source, line=line, happened=happened)
        )
    try:
        return tomllib.loads(content)
    except tomllib.TOMLDecodeError as error:
        raise InputError(_syntax_complaint(str(error), content, source)) from error
    except (ValueError, RecursionError) as error:
        raise InputError(
            Message("{source}: not TOML that can be read ({error}); correct it", source=source, error=error)
        ) from error


def without_mark(text: str) -> str:
    """The text without a byte order mark."""
    return text.removeprefix(BYTE_ORDER_MARK)


def _beyond_measure(text: str) -> Iterator[tuple[int, str]]:
    """Position of everything on which the parser would break, and what it is."""
    depth = dots = 0
    for token in _TOKEN.finditer(text):
        kind = token.lastgroup
        depth += (kind == "opening") - (kind == "closing")
        dots = 0 if kind == "end" else dots + (kind == "dot")
        if depth > MOST_NESTED:
            yield token.start(), Message("more than {most} brackets within each other", most=MOST_NESTED)
        if dots > MOST_NESTED:
            yield token.start(), Message("a key of more than {most} parts", most=MOST_NESTED)
        if kind == "number" and len(token[0]) > LONGEST_NUMBER:
            yield token.start(), Message("a number of {length} characters", length=len(token[0]))


def _syntax_complaint(message: str, text: str, source: str) -> str:
    place = _PLACE.search(message)
    last = text.rstrip("\n").count("\n") + 1
    where = Message("{source}, line {line}", source=source, line=place[1] or last) if place else source
    return Message("{where}: not TOML: {reason}; correct it", where=where, reason=_PLACE.sub("", message))
