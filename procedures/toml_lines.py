"""TOML files that a user wrote, checked against a model; every complaint names the line."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from tumble.calibrations.core.bounded import check_bounded
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.toml_text import read_toml, without_mark
from tumble.procedures.validation import problem_of, remedy_of
from tumble.system_errors import reason

Location: TypeAlias = tuple[str | int, ...]
"""Where a value stands: keys, and places in an array counted from 0, as in `("procedure", 1, "step_deg")`."""

Model = TypeVar("Model", bound=BaseModel)

MOST_BYTES = 1_000_000
"""Nobody writes more by hand."""

_PART = r"""[A-Za-z0-9_-]+|"[^"]*"|'[^']*'"""
_NAME = rf"(?:{_PART})(?:\s*\.\s*(?:{_PART}))*"
_HEADER = re.compile(rf"^\s*(\[\[?)\s*({_NAME})\s*\]")
_KEY = re.compile(rf"^\s*({_NAME})\s*=")


def load_toml(path: Path, model: type[Model]) -> Model:
    """Read the file `path` as a `model`.

    Raises
    ------
    InputError
        Where the file cannot be read, is not TOML or does not fit the model.
    """
    return parse_toml(read_text(path), model, path.name)


def read_text(path: Path) -> str:
    """Text of a UTF-8 file with its line ends as they are. Raises `InputError`."""
    try:
        check_bounded(path)
        with path.open("rb") as stream:
            content = stream.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:  # the latter where the name itself is impossible
        why = reason(error) if isinstance(error, OSError) else error
        raise InputError(Message("{path}: {reason}; give a file that can be read", path=path, reason=why)) from error
    if len(content) > MOST_BYTES:
        raise InputError(
            Message(
                "{path}: more than {most:,} bytes are no such file; give the right one",
                path=path,
                most=MOST_BYTES,
            )
        )
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError(
            Message("{path}: byte {start} is not UTF-8; save the file as UTF-8", path=path, start=error.start)
        ) from error


def parse_toml(text: str, model: type[Model], source: str) -> Model:
    """Like `load_toml`, for text that was already read; messages call it `source`."""
    data = read_toml(text, source)
    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise InputError(_complaint(error.errors(), text, data, source)) from error


def place_of(source: str, text: str, location: Location) -> str:
    """Where the value at `location` is written, as messages say it: `bench.toml, line 7`."""
    line = line_of(text, location)
    return source if line is None else Message("{source}, line {line}", source=source, line=line)


def line_of(text: str, location: Location) -> int | None:
    """Line, from 1, on which the value at `location` is written.

    Where the value itself is not found, because it is missing or stands inside an inline table, it is the line of the
    innermost table or key around it. None where not even that is found.
    """
    wanted = list(location)
    best_line, best_length = None, 0
    for path, line in _written(text):
        length = _common_length(path, wanted)
        if length == len(path) and length > best_length:
            best_line, best_length = line, length
    return best_line


def _common_length(path: Sequence[str | int], wanted: Sequence[str | int]) -> int:
    """Count the leading elements of `path` found in `wanted`, whose names of model variants are passed over."""
    found = 0
    for element in wanted:
        if found < len(path) and path[found] == element:
            found += 1
    return found


def _written(text: str) -> list[tuple[list[str | int], int]]:
    """Path and line of every table header and key, in the order of the text."""
    table: list[str | int] = []
    counts: dict[str, int] = {}
    found: list[tuple[list[str | int], int]] = []
    for line, content in enumerate(without_mark(text).split("\n"), start=1):
        if header := _HEADER.match(content):
            table = list(_parts(header[2]))
            if header[1] == "[[":
                counts[header[2]] = counts.get(header[2], -1) + 1
                table.append(counts[header[2]])
            found.append((table, line))
        elif key := _KEY.match(content):
            found.append(([*table, *_parts(key[1])], line))
    return found


def _parts(name: str) -> list[str]:
    return [part.strip("\"'") for part in re.findall(_PART, name)]


def _complaint(errors: Sequence[ErrorDetails], text: str, data: dict[str, Any], source: str) -> str:
    first = errors[0]
    place = [place_of(source, text, first["loc"]), *_words(first, data)]
    # A list whose items are wrong is also complained of as too short: what surrounds the first fault follows from it.
    others = sum(first["loc"][: len(error["loc"])] != error["loc"] for error in errors)
    complaint = Message(
        "{place}: {problem}; {remedy}",
        place=Message.joined(": ", place),
        problem=problem_of(first),
        remedy=remedy_of(first),
    )
    return Message("{complaint} (and {others} more)", complaint=complaint, others=others) if others else complaint


def _words(error: ErrorDetails, data: object) -> list[str]:
    """Put a location into words: `["procedure 2 (sweep)", "step_deg"]`."""
    location = [element for element in error["loc"] if element != "[key]"]
    missing = location[-1:] if error["type"] == "missing" else []
    words: list[str] = []
    for number, element in enumerate(location, start=1):
        if isinstance(element, int):
            words[-1:] = [f"{words[-1]} {element + 1}"]
        elif words and isinstance(data, dict) and element not in data and location[number - 1 :] != missing:
            words[-1:] = [f"{words[-1]} ({element})"]  # the variant of the model, which the file does not spell out
            continue
        else:
            words.append(element)
        data = _inside(data, element)
    return words


def _inside(data: object, element: str | int) -> object:
    """The value under a key or place; None where there is none."""
    try:
        return data[element]  # type: ignore[index]  # what cannot be indexed is the exception below
    except (KeyError, IndexError, TypeError):
        return None
