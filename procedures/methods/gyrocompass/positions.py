"""Positions of the turntable in their order, on one base."""

import csv
import json
from typing import Annotated, Final, Literal, TypeAlias

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from tumble.messages import Message
from tumble.procedures.composition import Dwells
from tumble.procedures.methods.gyrocompass.layout import dwell_at

MOST_POSITIONS: Final = 10_000
AZIMUTH_DEG: Final = "azimuth_deg"
"""Column of a table of positions."""
_Angle: TypeAlias = Annotated[float, Field(ge=-3600.0, le=3600.0)]


def parsed(positions: object) -> object:
    """Angles of a text such as `0/180/90/270`; anything else as it is. Raises `ValueError`."""
    return [_angle(part) for part in positions.split("/")] if isinstance(positions, str) else positions


class Positions(BaseModel):
    """Positions of the turntable, each a dwell, in the order in which they are taken."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    kind: Literal["positions"] = "positions"
    positions: Annotated[tuple[_Angle, ...], Field(min_length=1, max_length=MOST_POSITIONS), BeforeValidator(parsed)]
    """Pickoff angles in degrees, as a list or as `0/90/180`."""
    repeats: int = Field(default=1, ge=1, le=MOST_POSITIONS)
    """How often they are taken, one pass after the other."""
    base: int | None = Field(default=None, ge=1, le=1000)
    """Number of the way in which the base leans, for which a person is asked; without it, as it stands."""

    @property
    def poses(self) -> int:
        """Number of dwells."""
        return len(self.positions) * self.repeats

    def dwells(self, realisation: int) -> Dwells:
        """Take every position, pass by pass."""
        for azimuth_deg in self.positions * self.repeats:
            yield dwell_at(azimuth_deg, realisation, self.base)


def programme_of_list(text: str, name: str) -> str:
    """The programme of a table with the column azimuth_deg and no rates; empty for any other. Raises `ValueError`."""
    rows = list(csv.DictReader([line for line in text.splitlines() if line.strip() and not line.startswith("#")]))
    if not rows or AZIMUTH_DEG not in rows[0] or any("rate" in (key or "") for key in rows[0]):
        return ""
    angles = ", ".join(str(_angle(row[AZIMUTH_DEG] or "")) for row in rows)
    return f'method = "gyrocompass"\nname = {json.dumps(name)}\n\n[[procedure]]\npositions = [{angles}]\n'


def _angle(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(Message("{text!r} is no angle: write angles in degrees, as 0/90/180", text=text)) from None
