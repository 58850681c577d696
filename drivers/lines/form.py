"""What a line looks like, as a stand file declares it: read from text, and written by emulators."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from tumble.drivers.lines.checksum import CHECKSUMS
from tumble.drivers.quantities import Unit
from tumble.messages import Message

OVERLOAD: Final = 9.9e37
"""How what is out of its range is told, as SCPI instruments do."""
MARK: Final = "*"
"""Stands before a checksum."""
LITERAL: Final = "="
"""Begins a column that is always the same text."""
EVERYWHERE: Final = (-math.inf, math.inf)
UNUSED: Final = "-"
"""A column that nobody needs."""


class SpoiltLineError(ValueError):
    """A line is not what the stand file says; the text is the kind, in the plural."""


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A quantity in a column: its unit, and where values may be in our unit."""

    column: str
    unit: Unit
    range: tuple[float, float] = EVERYWHERE

    def of(self, theirs: float) -> float:
        """A value in our unit, 9.9e37 where it is out of range."""
        ours = self.unit.to_ours(theirs)
        low, high = self.range
        return ours if math.isnan(ours) or low <= ours <= high else OVERLOAD


@dataclass(frozen=True, kw_only=True)
class Sample:
    """What one line says."""

    values: Mapping[str, float]
    """By channel, in its unit; NaN where the line holds no number."""
    temperature_degc: float | None
    count: int | None
    """The counter, where there is one."""


@dataclass(frozen=True, kw_only=True)
class LineForm:
    """How lines are made of columns."""

    columns: tuple[str, ...]
    quantities: Mapping[str, Quantity]
    """By channel."""
    start: str = ""
    """Text before the first column, which no checksum covers."""
    separator: str = ","
    checksum: str = "none"
    temperature: Quantity | None = None
    counter: str = ""
    terminator: bytes = b"\n"
    _places: Mapping[str, int] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_places", {name: place for place, name in enumerate(self.columns)})

    def read(self, line: bytes) -> Sample:
        """What a line says. Raises `SpoiltLineError`."""
        fields = self._fields(line.strip())
        for place, column in enumerate(self.columns):
            if column.startswith(LITERAL) and fields[place] != column.removeprefix(LITERAL):
                raise SpoiltLineError(Message("lines of another kind"))
        degc = self.temperature.of(self._number(fields, self.temperature.column)) if self.temperature else None
        return Sample(
            values={name: each.of(self._number(fields, each.column)) for name, each in self.quantities.items()},
            temperature_degc=degc,
            count=self._count(fields),
        )

    def write(self, values: Mapping[str, float], temperature_degc: float, count: int) -> bytes:
        """The line that says this, values by channel in our units; a column that nobody needs is 0."""
        told = {each.column: each.unit.to_theirs(values[name]) for name, each in self.quantities.items()}
        if self.temperature:
            told[self.temperature.column] = self.temperature.unit.to_theirs(temperature_degc)
        texts = {name: f"{value:.9g}" for name, value in told.items()} | {self.counter: str(count)}
        fields = (
            name.removeprefix(LITERAL) if name.startswith(LITERAL) else texts.get(name, "0") for name in self.columns
        )
        body = self.separator.join(fields)
        checksum = MARK + CHECKSUMS[self.checksum](body.encode()) if self.checksum in CHECKSUMS else ""
        return f"{self.start}{body}{checksum}\r\n".encode()

    def _fields(self, line: bytes) -> list[str]:
        start = self.start.encode()
        if not line.startswith(start):
            raise SpoiltLineError(Message("lines with another beginning"))
        body = line[len(start) :]
        if self.checksum in CHECKSUMS:
            body, mark, told = body.rpartition(MARK.encode())
            if not mark or told.decode("ascii", "replace").upper() != CHECKSUMS[self.checksum](body):
                raise SpoiltLineError(Message("lines with a wrong checksum"))
        fields = [text.strip() for text in body.decode("ascii", "replace").split(self.separator.strip() or None)]
        if len(fields) != len(self.columns):
            raise SpoiltLineError(Message("lines with more or fewer columns"))
        return fields

    def _number(self, fields: list[str], column: str) -> float:
        text = fields[self._places[column]]
        try:
            return float(text.replace("_", "?")) if text else math.nan  # Python's own numbers may have underscores
        except ValueError:
            raise SpoiltLineError(Message("lines with what is no number")) from None

    def _count(self, fields: list[str]) -> int | None:
        if not self.counter:
            return None
        text = fields[self._places[self.counter]]
        if not (text.isascii() and text.isdecimal()):
            raise SpoiltLineError(Message("lines whose counter is no number"))
        return int(text)
