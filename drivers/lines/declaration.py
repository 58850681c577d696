"""An instrument that tells numbers in lines of text, in a stand file."""

from collections.abc import Iterator
from typing import Self

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from tumble.drivers.driver import Bench, Driver
from tumble.drivers.lines.checksum import ChecksumName
from tumble.drivers.lines.form import EVERYWHERE, LITERAL, UNUSED, LineForm, Quantity
from tumble.drivers.lines.sampler import LineSampler, Requests
from tumble.drivers.names import GivenName
from tumble.drivers.quantities import unit_called
from tumble.drivers.tables import DaqTable, OnSerialLine
from tumble.messages import Message


class MeasuredColumn(BaseModel):
    """What stands in a column."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    column: GivenName
    unit: str = ""
    """In which the line tells it; without it, the one with which the name of the channel ends."""
    range: tuple[float, float] | None = None
    """Where values may be, in the unit of the channel; what is beyond is an overload, and for long a wrong unit."""

    @field_validator("range")
    @classmethod
    def _in_order(cls, limits: tuple[float, float] | None) -> tuple[float, float] | None:
        if limits and not limits[0] < limits[1]:
            raise ValueError(Message("{low:g} is not below {high:g}", low=limits[0], high=limits[1]))
        return limits


class LinesTable(OnSerialLine, DaqTable):
    """`driver = "lines"`."""

    columns: tuple[GivenName, ...] = Field(min_length=1)
    """Names of the columns in their order; `=TEXT` for one that is always that text, `-` for one that nobody needs."""
    measured: dict[GivenName, MeasuredColumn] = Field(min_length=1)
    """Where every channel stands; the name of a channel ends with its unit (`_deg_h`, `_deg`, `_v`)."""
    temperature: MeasuredColumn | None = None
    counter: str = ""
    """Column of a counter that goes up by one from line to line."""
    counter_modulus: int = Field(default=65_536, ge=2)
    """How far it counts before it begins again at 0."""
    start: str = ""
    """Text before the first column, outside the checksum: `$`, say."""
    separator: str = Field(default=",", min_length=1)
    """Between two columns; a space stands for any white space."""
    checksum: ChecksumName = "none"
    """Behind the last column and a `*`, in hexadecimal digits."""
    request: str = ""
    """What has it send one line; without it, it sends by itself, `rate_hz` lines a second."""
    identity_request: str = ""
    """What has it say who it is."""
    identity_start: str = "ID,"
    """How the line begins that says it; then model, serial number and firmware, with commas between."""

    @model_validator(mode="after")
    def _of_the_columns(self) -> Self:
        used = [*self._named(), *([self.counter] if self.counter else [])]
        for name in used:
            if name not in self.columns or name == UNUSED or name.startswith(LITERAL):
                raise ValueError(
                    Message("no column is called {name}: columns has {there}", name=name, there=", ".join(self.columns))
                )
        if twice := next((name for name in used if self.columns.count(name) > 1 or used.count(name) > 1), None):
            raise ValueError(Message("column {name} is named twice: give each its own", name=twice))
        for channel, each in self.measured.items():
            unit_called(each.unit, channel)
        if self.temperature and self.temperature.unit:
            unit_called(self.temperature.unit, "_degc")
        return self

    def _named(self) -> Iterator[str]:
        yield from (each.column for each in self.measured.values())
        if self.temperature:
            yield self.temperature.column

    @property
    def form(self) -> LineForm:
        """What a line looks like."""
        return LineForm(
            columns=self.columns,
            quantities={channel: _quantity(each, channel) for channel, each in self.measured.items()},
            temperature=_quantity(self.temperature, "_degc") if self.temperature else None,
            counter=self.counter,
            start=self.start,
            separator=self.separator,
            checksum=self.checksum,
        )


def _quantity(told: MeasuredColumn, channel: str) -> Quantity:
    unit = unit_called(told.unit, channel)
    return Quantity(column=told.column, unit=unit, range=told.range or EVERYWHERE)


def _connect(table: LinesTable, bench: Bench) -> LineSampler:
    requests = Requests(line=table.request, identity=table.identity_request, identity_start=table.identity_start)
    modulus = table.counter_modulus if table.counter else 0
    return LineSampler(bench.links.serial(table, "serial DAQ"), table.form, bench.clock, requests, modulus=modulus)


LINES = Driver(table=LinesTable, connect=_connect)
