"""A parameter as a record holds it, of whatever method."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Given:
    """The value of another parameter, not measured, for which a value stands."""

    name: str
    value: float
    unit: str

    @property
    def words(self) -> str:
        """`NAME = 0°`."""
        unit = "°" if self.unit == "deg" else f" {self.unit}" if self.unit else ""
        return f"{self.name} = {self.value:g}{unit}"


@dataclass(frozen=True, kw_only=True)
class RecordedParameter:
    """One parameter with its uncertainty, or the reason why it has no value."""

    name: str
    unit: str
    value: float | None
    """None where it is not identifiable."""
    standard_uncertainty: float | None
    """Combined (GUM 5.1.2)."""
    type_a: float | None
    """The part of it that comes from the scatter of the data."""
    degrees_of_freedom: float | None
    """Effective; infinite where all is type B, None without a value."""
    interval_95: tuple[float, float] | None
    reason: str = ""
    """Why there is no value; empty where there is one."""
    given: tuple[Given, ...] = ()
    rests_on: str = ""
    """A parameter without which this one would not be identifiable."""
    remark: str = ""
    settled_by: tuple[str, ...] = ()
    """Measurements that would settle it, each alone."""

    @property
    def condition(self) -> str:
        """On what the value stands though that was not measured; empty where it stands by itself."""
        if self.given:
            return Message("given {values}", values=", ".join(given.words for given in self.given))
        return Message("rests on {name} alone", name=self.rests_on) if self.rests_on else ""


def parameters_from_json(stored: Sequence[Mapping[str, Any]]) -> dict[str, RecordedParameter]:
    """Parameters by name from JSON objects as results have them, each with its `name`, in their order.

    Only `value` is needed, and it may be null. Raises `KeyError`, `TypeError` or `ValueError` for what is none.
    """
    units = {str(each["name"]): str(each.get("unit", "")) for each in stored}
    return {str(each["name"]): _parameter(each, units) for each in stored}


def named(parameters: Mapping[str, Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Parameters by name as a list: JSON with sorted keys would lose their order."""
    return [{"name": name, **content} for name, content in parameters.items()]


def _parameter(content: Mapping[str, Any], units: Mapping[str, str]) -> RecordedParameter:
    value, interval = content["value"], content.get("interval_95")
    return RecordedParameter(
        name=content["name"],
        unit=content.get("unit", ""),
        value=value,
        standard_uncertainty=content.get("standard_uncertainty"),
        type_a=content.get("type_a"),
        # JSON has no infinity: a value without degrees of freedom has infinitely many.
        degrees_of_freedom=None if value is None else content.get("degrees_of_freedom", math.inf),
        interval_95=(interval[0], interval[1]) if interval else None,
        reason=content.get("reason", ""),
        given=tuple(
            Given(name=name, value=given, unit=units.get(name, "")) for name, given in content.get("given", {}).items()
        ),
        rests_on=content.get("rests_on", ""),
        remark=content.get("remark", ""),
        settled_by=tuple(content.get("settled_by", ())),
    )
