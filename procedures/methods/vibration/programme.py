"""Programmes of vibration rectification: lists of excitations in lists of mountings."""

from collections.abc import Mapping, Sequence
from typing import ClassVar, Literal, Self, TypeAlias

from pydantic import Field, field_validator, model_validator

from tumble.drivers.mountings import Mounting
from tumble.drivers.tables import MOUNT
from tumble.procedures.layout import Layout
from tumble.procedures.methods.vibration.layout import LAYOUT, OUTPUT
from tumble.procedures.methods.vibration.procedures import VibrationProcedure
from tumble.procedures.programme import Limit, Programme, check_ends
from tumble.procedures.steps import Dwell

VibrationParameter: TypeAlias = Literal["k_ii", "k_oo", "k_pp", "k_io", "k_ip"]


class VibrationProgramme(Programme):
    """Lists of excitations. Limits: second-order coefficients in µg/g²."""

    layout: ClassVar[Layout] = LAYOUT

    method: Literal["vibration"]
    procedures: tuple[VibrationProcedure, ...] = Field(min_length=1, alias="procedure")
    scale_v_per_g: float = Field(default=1.0, alias="scale_V_per_g")
    """Scale factor of the unit, by which its output becomes an acceleration."""
    settle_s: float = Field(default=0.5, ge=0.0)
    settle_tolerance: float = Field(default=30.0, gt=0.0)
    """Means of short blocks of a vibrated output differ by what is left of a period."""
    limits: Mapping[VibrationParameter, Limit] = Field(default_factory=dict)  # type: ignore[assignment]  # fewer keys

    @field_validator("procedures", mode="before")
    @classmethod
    def _with_kinds(cls, procedures: object) -> object:
        """A procedure without a kind is one of sines."""
        if not isinstance(procedures, Sequence) or isinstance(procedures, str):
            return procedures
        return [{"kind": "sine", **each} if isinstance(each, Mapping) else each for each in procedures]

    @model_validator(mode="after")
    def _ends_one_day(self) -> Self:
        check_ends(self.realisations * sum(each.poses for each in self.procedures))
        return self

    @property
    def parts(self) -> Sequence[VibrationProcedure]:
        """The lists, in order."""
        return self.procedures

    def nominal(self, dwell: Dwell) -> Mapping[str, float]:
        """Output of a unit that follows gravity and nothing else."""
        along_i_g = Mounting.of(dwell.conditions[MOUNT]).gravity_g[0]
        return {OUTPUT: self.scale_v_per_g * float(along_i_g)}
