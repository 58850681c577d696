"""The tables of a stand file that are instruments: `[head]` and `[daq]`, and any number of others by name.

`[head]` is the positioner called head and `[daq]` the sampler called daq. Further ones are `[positioners.NAME]` and
`[samplers.NAME]`; where there are such, the stand need have neither of the two.
`[chamber]` is a temperature chamber, and `[exciter]` what shakes the unit.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, create_model

from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.tables import CHAMBER, DAQ, EXCITER, HEAD, ChamberTable, DaqTable, HeadTable

POSITIONERS: Final = "positioners"
SAMPLERS: Final = "samplers"

Data: TypeAlias = Mapping[str, Any]
"""A stand file as TOML gives it, whatever somebody wrote there."""


class Tables(BaseModel):
    """Tables by name, each with a type of its own; made by `tables_of`."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @property
    def by_name(self) -> dict[str, Any]:
        """The tables."""
        return {str(field.alias): getattr(self, name) for name, field in type(self).model_fields.items()}


def tables_of(types: Mapping[str, type[BaseModel]]) -> type[Tables]:
    """The schema of tables that have these names and types."""
    fields: dict[str, Any] = {
        f"table_{number}": (kind, Field(alias=name)) for number, (name, kind) in enumerate(types.items())
    }
    return create_model("Tables", __base__=Tables, **fields)


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where the table of an instrument stands, and what it is."""

    name: str
    """Of the instrument at the stand."""
    location: tuple[str, ...]
    """Keys that lead to it."""
    kind: type[HeadTable] | type[DaqTable] | type[ChamberTable] | type[ExciterTable]

    @property
    def where(self) -> str:
        """The keys as sentences say them: `positioners: outer`."""
        return ": ".join(self.location)

    def table(self, data: Data) -> Mapping[str, Any]:
        """The table as data; empty where something else stands there."""
        found: Any = data
        for key in self.location:
            found = found.get(key) if isinstance(found, Mapping) else None
        return found if isinstance(found, Mapping) else {}


def places(data: Data) -> Iterator[Place]:
    """Every table of an instrument that a stand file has, or must have."""
    for single, several, kind in ((HEAD, POSITIONERS, HeadTable), (DAQ, SAMPLERS, DaqTable)):
        if single in data or (several not in data and not (single == HEAD and EXCITER in data)):
            yield Place(name=single, location=(single,), kind=kind)
        named = data.get(several)
        for name in named if isinstance(named, Mapping) else ():
            yield Place(name=name, location=(several, name), kind=kind)
    if CHAMBER in data:
        yield Place(name=CHAMBER, location=(CHAMBER,), kind=ChamberTable)
    if EXCITER in data:
        yield Place(name=EXCITER, location=(EXCITER,), kind=ExciterTable)
