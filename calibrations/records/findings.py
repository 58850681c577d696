"""What the closed loop found in a result, whatever method it is of."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

from tumble.calibrations.records.record import Record
from tumble.messages import Message, with_wording

UNNAMED: Final = "structure without a name"
"""Stands for it among the names of effects, none of which has a space."""


def effects_of(record: Record) -> tuple[Mapping[str, Any], ...]:
    """The effects found, of every loop in a result: its own, the one that was closed on it, one of each parameter."""
    return tuple(_effects(record.result))


def is_unexplained(record: Record) -> bool:
    """Whether a loop found structure without a name."""
    return _is_unexplained(record.result)


def names_found(record: Record) -> tuple[str, ...]:
    """Everything that was found, each once, as records are searched for it."""
    return names_of(text_of(record.result))


def words_of(name: str) -> str:
    """What a reader calls it."""
    return Message("structure without a name") if name == UNNAMED else with_wording(name)


def text_of(result: Mapping[str, Any]) -> str:
    """The names of what was found, each on a line that begins and ends with a line break; empty for nothing."""
    names = {effect["name"] for effect in _effects(result)} | ({UNNAMED} if _is_unexplained(result) else set())
    return "\n".join(("", *sorted(names), "")) if names else ""


def names_of(text: str) -> tuple[str, ...]:
    """Undo `text_of`."""
    return tuple(filter(None, text.split("\n")))


def line_of(name: str) -> str:
    """What the text of a record that found a name contains."""
    return f"\n{name}\n"


def _effects(result: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    for loop in _loops(result):
        found = loop.get("effects")
        yield from (each for each in found if _has_a_name(each)) if isinstance(found, list) else ()


def _has_a_name(effect: object) -> bool:
    return isinstance(effect, Mapping) and isinstance(effect.get("name"), str)


def _is_unexplained(result: Mapping[str, Any]) -> bool:
    return any(loop.get("unexplained") for loop in _loops(result))


def _loops(result: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Those that can be read as one: whatever else somebody put there is for `verify` to say."""
    parameters = result.get("parameters")
    of_parameters = parameters.values() if isinstance(parameters, Mapping) else ()
    yield from (each for each in (result.get("loop", result), *of_parameters) if isinstance(each, Mapping))
