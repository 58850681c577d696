"""Kinds of values that can be set at the multimeter, within which bounds, and how they are written in an answer."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from tumble.emulators.scpi.language import ScpiError, number, quoted, word

Value = float | str
"""A number, also for switches (0 and 1), or a word."""


class Kind(Protocol):
    """How the values of a setting are read and written."""

    @property
    def default(self) -> Value:
        """Value after `*RST`."""
        ...

    def read(self, text: str) -> Value:
        """Value of a parameter. Raises `ScpiError`."""
        ...

    def write(self, value: Value) -> str:
        """The value as an answer."""
        ...


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with bounds; with `steps` it is rounded up to the next of them. Fits `Kind`."""

    low: float
    high: float
    default: float
    unit: str = ""
    steps: tuple[float, ...] = ()
    unlimited: bool = False
    """Whether INF is allowed."""

    def read(self, text: str) -> float:
        """A number, MIN, MAX, DEF, or INF where it is allowed."""
        names = {"MINimum": self.low, "MAXimum": self.high, "DEFault": self.default}
        if self.unlimited:
            names["INFinity"] = math.inf
        if text[:1].isalpha():
            meant = word(text, tuple(names))
            return next(value for name, value in names.items() if name.startswith(meant))
        value = number(text, self.unit)
        if not self.low <= value <= self.high:
            raise ScpiError(-222)
        return next((step for step in self.steps if step >= value * (1.0 - 1e-9)), value)

    def write(self, value: Value) -> str:
        """As the instrument writes a reading."""
        return write_real(float(value))


@dataclass(frozen=True, kw_only=True)
class Count(Quantity):
    """A whole number. Fits `Kind`."""

    def read(self, text: str) -> float:
        """A number, rounded."""
        value = super().read(text)
        return float(round(value)) if math.isfinite(value) else value

    def write(self, value: Value) -> str:
        """Without a decimal point, as NR1."""
        return f"{int(value):+d}" if math.isfinite(float(value)) else write_real(float(value))


@dataclass(frozen=True, kw_only=True)
class Switch:
    """On or off; ONCE does its work and leaves it off. Fits `Kind`."""

    default: float

    def read(self, text: str) -> float:
        """ON, OFF, ONCE or a number, of which all but 0 mean on."""
        if text[:1].isalpha():
            return float(word(text, ("ON", "OFF", "ONCE")) == "ON")
        return float(round(number(text)) != 0)

    def write(self, value: Value) -> str:
        """As 0 or 1."""
        return str(int(value))


@dataclass(frozen=True, kw_only=True)
class Choice:
    """One of several words. Fits `Kind`."""

    choices: tuple[str, ...]
    default: str

    def read(self, text: str) -> str:
        """The word in its short form."""
        return word(text, self.choices)

    def write(self, value: Value) -> str:
        """The short form."""
        return str(value)


@dataclass(frozen=True, kw_only=True)
class Text:
    """Any text in quotation marks. Fits `Kind`."""

    default: str = ""

    def read(self, text: str) -> str:
        """What stands between the marks."""
        return quoted(text)

    def write(self, value: Value) -> str:
        """In quotation marks."""
        return f'"{value}"'


@dataclass(frozen=True, kw_only=True)
class Setting:
    """Something that can be set and asked."""

    header: str
    kind: Kind
    also: Mapping[str, float] = field(default_factory=dict)
    """Other settings that change with it."""


def write_real(value: float) -> str:
    """A number as these instruments write it: infinity and NaN as in SCPI-1999, volume 1, 7.2.1.5."""
    if math.isnan(value):
        value = 9.91e37
    elif math.isinf(value):
        value = math.copysign(9.9e37, value)
    return f"{value:+.8E}"
