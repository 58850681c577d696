"""A list of positions of both axes, in one order or another."""

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Literal, Self, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from tumble.calibrations.methods.triad.programmes import POSITIONS
from tumble.messages import Message
from tumble.procedures.composition import Dwells
from tumble.procedures.methods.triad.layout import CHAMBER, dwell_at

MOST_POSITIONS = 10_000
OUTER_DEG = "outer_deg"
INNER_DEG = "inner_deg"
"""Columns of a table of positions."""
Position: TypeAlias = tuple[float, float]


class Positions(BaseModel):
    """Positions of both axes: a list that comes along, or one's own."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    kind: Literal["positions"] = "positions"
    list_name: str = Field(default="", alias="list")
    """One of those that come along: 24, 18, 12, 6, 24f, 16o, 12o, 8o, fine."""
    positions: Annotated[tuple[Position, ...], Field(max_length=MOST_POSITIONS)] = ()
    """Outer and inner angle of each, in degrees, in place of `list`."""
    order: Literal["as-listed", "there-and-back", "shuffled"] = "as-listed"
    """`there-and-back` takes the list, and then again from its end: a drift in time falls on no parameter."""
    seed: int = Field(default=0, ge=0)
    """Seed of the order `shuffled`; the others do not use it."""

    @model_validator(mode="after")
    def _one_list(self) -> Self:
        if bool(self.list_name) == bool(self.positions):
            raise ValueError(Message("name one list, or give positions, and not both"))
        if self.list_name and self.list_name not in POSITIONS:
            known = ", ".join(POSITIONS)
            raise ValueError(Message("no list is called {name!r}; known are {known}", name=self.list_name, known=known))
        return self

    @property
    def listed(self) -> Sequence[Position]:
        """Outer and inner angle of each position, in degrees, in the order of the list."""
        return POSITIONS[self.list_name] if self.list_name else self.positions

    @property
    def poses(self) -> int:
        """Number of dwells."""
        return len(self.listed) * (2 if self.order == "there-and-back" else 1)

    def ordered(self, realisation: int) -> Sequence[Position]:
        """The positions in the order in which they are taken; `shuffled` has its own for every realisation."""
        listed = list(self.listed)
        match self.order:
            case "as-listed":
                return listed
            case "there-and-back":
                return listed + listed[::-1]
            case "shuffled":
                generator = np.random.default_rng(self.seed + realisation)
                return [listed[number] for number in generator.permutation(len(listed))]

    def dwells(self, realisation: int) -> Dwells:
        """Take every position once, or there and back."""
        for outer_deg, inner_deg in self.ordered(realisation):
            yield dwell_at(outer_deg, inner_deg, realisation)


def programme_of_list(text: str, name: str) -> str:
    """The programme of a table of positions with the columns outer_deg and inner_deg; empty for any other table.

    Raises `ValueError` where an angle is none.
    """
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    if not rows or not {OUTER_DEG, INNER_DEG} <= set(rows[0]) or any(key.startswith("u_") for key in rows[0]):
        return ""
    places = ",\n".join(f"    [{_angle(row, OUTER_DEG)}, {_angle(row, INNER_DEG)}]" for row in rows)
    return (
        f'method = "triad"\nname = {json.dumps(name)}\ndwell_s = 20.0\n\n[[procedure]]\npositions = [\n{places},\n]\n'
    )


def _angle(row: Mapping[str, str], column: str) -> float:
    try:
        return float(row[column])
    except (TypeError, ValueError):
        raise ValueError(Message("{value!r} in {column} is no angle", value=row[column], column=column)) from None


@dataclass(frozen=True)
class AtTemperature:
    """Positions that are taken once the unit is soaked to a temperature. Fits `composition.Part`."""

    positions: Positions
    temperature_degc: float

    def dwells(self, realisation: int) -> Dwells:
        """The same dwells, each under that condition."""
        for dwell in self.positions.dwells(realisation):
            yield replace(dwell, conditions={CHAMBER: f"{self.temperature_degc:g}"})
