"""The columns of a method's points: declared once, and everything that names a column is derived from them.

A point goes by positioner, channel and condition; a table and a recording go by columns. A method says which column is
what, and how a recording calls the step in which a condition is set.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, TypeAlias

from tumble.messages import Message, with_wording
from tumble.procedures.steps import Ask, Dwell, Point, Reading

Fields: TypeAlias = dict[str, Any]
"""Columns and their values."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """Name of a column and what stands in it."""

    name: str
    meaning: str


@dataclass(frozen=True, kw_only=True)
class PositionColumns:
    """Where a positioner stood, in degrees, and the sign of its last move."""

    position_deg: Column
    direction: Column

    def described(self) -> dict[str, tuple[str, str]]:
        """JSON type and meaning of both, by their names."""
        return {
            self.position_deg.name: ("number", self.position_deg.meaning),
            self.direction.name: ("integer", self.direction.meaning),
        }


@dataclass(frozen=True, kw_only=True)
class ChannelColumns:
    """What a channel gave: mean, standard deviation of the single samples, and their number."""

    mean: Column
    sd: Column
    samples: Column
    temperature: Column | None = None
    """By a thermometer of its own, °C; None for a method that knows one temperature of the whole."""
    optional: bool = False
    """Whether a stand may be without the channel."""

    def described(self) -> dict[str, tuple[str, str]]:
        """JSON type and meaning of the columns, by their names."""
        numbers = (self.mean, self.sd, *((self.temperature,) if self.temperature else ()))
        return {column.name: ("number", column.meaning) for column in numbers} | {
            self.samples.name: ("integer", self.samples.meaning)
        }

    def fields(self, reading: Reading) -> Fields:
        """A reading by columns; a temperature that there is not is left out."""
        measured: Fields = {self.mean.name: reading.mean, self.sd.name: reading.sd}
        if self.temperature and reading.temperature_degc is not None:
            measured[self.temperature.name] = reading.temperature_degc
        return {**measured, self.samples.name: reading.samples}


@dataclass(frozen=True, kw_only=True)
class Condition:
    """What the operator sets by hand between dwells."""

    meaning: str
    step: str
    """How a recording calls the step in which it is set."""
    task: str
    remedy: str
    prompt: str
    hint: str
    """Templates of the messages of `Ask`; in each `{value}` stands for what is wanted."""
    optional: bool = False
    """Whether a dwell may leave it as it is."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """The columns of a method. Of several conditions each has its own column, named like it."""

    positions: Mapping[str, PositionColumns]
    channels: Mapping[str, ChannelColumns]
    conditions: Mapping[str, Condition] = field(default_factory=dict)

    def ask(self, condition: str, value: str) -> Ask:
        """The step in which a condition is set."""
        words = self.conditions[condition]
        return Ask(
            condition=condition,
            value=value,
            task=Message.marked(words.task, value=with_wording(value)),
            remedy=Message.marked(words.remedy, value=value),
            prompt=Message.marked(words.prompt, value=value),
            hint=Message.marked(words.hint, value=value),
        )

    def point_fields(self, point: Point) -> Fields:
        """A point by columns."""
        fields: Fields = {"index": point.index}
        if point.take > 1:
            fields["take"] = point.take
        for name, position in self.positions.items():
            fields[position.position_deg.name] = point.positions_deg[name]
        for name, channel in self.channels.items():
            if not channel.optional or name in point.readings:
                fields |= channel.fields(point.readings[name])
        fields["time_s"] = point.time_s
        for name, position in self.positions.items():
            fields[position.direction.name] = point.directions[name]
        origin = {"realisation": point.realisation, "procedure": point.procedure, **point.conditions}
        return {**fields, "temperature_degc": point.temperature_degc, **origin, "settled": point.settled}

    def point(self, fields: Mapping[str, Any]) -> Point:
        """The point of such columns. Raises `KeyError`, `TypeError` or `ValueError` where one is missing or wrong."""
        temperature = fields.get("temperature_degc")
        return Point(
            index=fields["index"],
            positions_deg={name: float(fields[it.position_deg.name]) for name, it in self.positions.items()},
            directions={name: fields[it.direction.name] for name, it in self.positions.items()},
            readings={
                name: _reading(it, fields)
                for name, it in self.channels.items()
                if not it.optional or it.mean.name in fields
            },
            time_s=float(fields["time_s"]),
            temperature_degc=None if temperature is None else float(temperature),
            procedure=fields["procedure"],
            realisation=fields["realisation"],
            conditions=self._conditions(fields),
            settled=fields["settled"],
            take=fields.get("take", 1),
        )

    def dwell_fields(self, dwell: Dwell) -> Fields:
        """A dwell by columns: conditions, positions, and what it belongs to."""
        positions = {self.positions[name].position_deg.name: angle for name, angle in dwell.targets_deg.items()}
        return {**dwell.conditions, **positions, "procedure": dwell.procedure, "realisation": dwell.realisation}

    def dwell(self, fields: Mapping[str, Any]) -> Dwell:
        """The dwell of such columns. Raises as `point`."""
        columns = {name: it.position_deg.name for name, it in self.positions.items()}
        return Dwell(
            targets_deg={name: float(fields[column]) for name, column in columns.items() if column in fields},
            channels=tuple(name for name, it in self.channels.items() if not it.optional),
            further=tuple(name for name, it in self.channels.items() if it.optional),
            procedure=fields["procedure"],
            realisation=fields["realisation"],
            conditions=self._conditions(fields),
        )

    def _conditions(self, fields: Mapping[str, Any]) -> dict[str, str]:
        """What is said of conditions; one that is needed and missing is a `KeyError`."""
        return {name: fields[name] for name, each in self.conditions.items() if not each.optional or name in fields}

    def described(self) -> dict[str, tuple[str, str]]:
        """JSON type and meaning of every column of a point, by its name."""
        columns: dict[str, tuple[str, str]] = {"index": POINT_INDEX, "take": TAKE}
        columns |= {it.position_deg.name: ("number", it.position_deg.meaning) for it in self.positions.values()}
        for channel in self.channels.values():
            columns |= channel.described()
        columns["time_s"] = TIME
        columns |= {it.direction.name: ("integer", it.direction.meaning) for it in self.positions.values()}
        columns |= {"temperature_degc": TEMPERATURE_MEAN, "realisation": REALISATION, "procedure": PROCEDURE}
        return columns | self.described_conditions() | {"settled": SETTLED}

    def described_conditions(self) -> dict[str, tuple[str, str]]:
        """The same of the conditions."""
        return {name: ("string", condition.meaning) for name, condition in self.conditions.items()}


def _reading(columns: ChannelColumns, fields: Mapping[str, Any]) -> Reading:
    mean, sd = float(fields[columns.mean.name]), float(fields[columns.sd.name])
    degc = fields.get(columns.temperature.name) if columns.temperature else None
    temperature_degc = None if degc is None else float(degc)
    return Reading(mean=mean, sd=sd, samples=fields[columns.samples.name], temperature_degc=temperature_degc)


POINT_INDEX: Final = ("integer", "number of the point in the run, from 0")
TAKE: Final = ("integer", "which taking of the point, from 1; left out where it is the first")
TIME: Final = ("number", "middle of the dwell, s since the run began, by the stand's clock")
TEMPERATURE_MEAN: Final = ("number", "mean of the temperature channel, °C")
REALISATION: Final = ("integer", "which repeat, from 1")
PROCEDURE: Final = ("string", "what the dwell belongs to")
SETTLED: Final = ("boolean", "false where the output was still moving when the time for settling was over")
