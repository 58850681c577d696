"""The effects that a record holds."""

from collections.abc import Iterator, Mapping
from typing import Any

from tumble.calibrations.records.record import Record


def effects_of(record: Record) -> tuple[Mapping[str, Any], ...]:
    """The effects found, of every loop in a result: its own, the one that was closed on it, one of each parameter."""
    return tuple(effect for loop in _loops(record.result) for effect in loop.get("effects", ()))


def is_unexplained(record: Record) -> bool:
    """Whether a loop found structure without a name."""
    return any(loop.get("unexplained") for loop in _loops(record.result))


def _loops(result: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    yield result.get("loop", result)
    parameters = result.get("parameters")
    if isinstance(parameters, Mapping):
        yield from (each for each in parameters.values() if "effects" in each)
