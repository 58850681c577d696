"""Programmes of a triad: lists of positions, repeated, at one temperature or at several."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal, Self, TypeAlias

import numpy as np
from pydantic import Field, model_validator

from tumble.calibrations.methods.triad.geometry import directions
from tumble.procedures.layout import Layout
from tumble.procedures.methods.triad.layout import CHANNELS, INNER, LAYOUT, OUTER
from tumble.procedures.methods.triad.positions import AtTemperature, Positions
from tumble.procedures.programme import Limit, Programme, check_ends
from tumble.procedures.steps import Dwell

TriadParameter: TypeAlias = Literal[
    "bias_x", "bias_y", "bias_z", "scale_x", "scale_y", "scale_z",
    "m_xy", "m_xz", "m_yx", "m_yz", "m_zx", "m_zy", "level_x", "level_y",
]  # fmt: skip
_Temperature: TypeAlias = Annotated[float, Field(ge=-273.15, le=1000.0)]


class TriadProgramme(Programme):
    """Lists of positions. Limits: biases in V, scale factors in V/g, misalignments and levels in arc seconds."""

    layout: ClassVar[Layout] = LAYOUT

    method: Literal["triad"]
    procedures: tuple[Positions, ...] = Field(min_length=1, alias="procedure")
    temperatures_degc: Annotated[tuple[_Temperature, ...], Field(max_length=1000)] = Field(
        default=(), alias="temperatures_degC"
    )
    """All lists are taken at each of these, in this order, once the unit is soaked to it; without it as it is."""
    limits: Mapping[TriadParameter, Limit] = Field(default_factory=dict)  # type: ignore[assignment]  # fewer keys

    @model_validator(mode="after")
    def _ends_one_day(self) -> Self:
        passes = self.realisations * max(1, len(self.temperatures_degc))
        check_ends(passes * sum(each.poses for each in self.procedures))
        return self

    @property
    def parts(self) -> tuple[Positions | AtTemperature, ...]:
        """The lists, in order, at each temperature in turn."""
        if not self.temperatures_degc:
            return self.procedures
        return tuple(AtTemperature(each, degc) for degc in self.temperatures_degc for each in self.procedures)

    def where(self, procedure: int) -> str:
        """File and line of a list, counted from 0 through all temperatures."""
        return super().where(procedure % len(self.procedures))

    def nominal(self, dwell: Dwell) -> Mapping[str, float]:
        """Outputs of a unit that gives 1 V/g along each axis and nothing else."""
        outer_deg, inner_deg = (np.array([dwell.targets_deg[name]]) for name in (OUTER, INNER))
        gravity_g = directions(outer_deg, inner_deg).level[0]
        return dict(zip(CHANNELS, gravity_g.tolist(), strict=True))
