"""Programmes of the dividing head: flips and sweeps."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, ClassVar, Literal, TypeAlias

import numpy as np
from pydantic import Field, model_validator

from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.drivers.protocols import VOLTAGE
from tumble.procedures.layout import Layout
from tumble.procedures.methods.dividing_head.flip import Flip
from tumble.procedures.methods.dividing_head.layout import HEAD, LAYOUT, MOUNT
from tumble.procedures.methods.dividing_head.sweep import Sweep
from tumble.procedures.programme import Limit, Programme, check_ends
from tumble.procedures.steps import Dwell

Parameter: TypeAlias = Literal["u0", "kx", "ky", "kz", "kxy", "alpha0"]


class DividingHeadProgramme(Programme):
    """Flips and sweeps, repeated. Limits: u0 in V, kx, ky, kz in V/g, kxy in V/g², alpha0 in deg."""

    layout: ClassVar[Layout] = LAYOUT

    method: Literal["dividing_head"] = "dividing_head"
    procedures: tuple[Annotated[Flip | Sweep, Field(discriminator="kind")], ...] = Field(
        min_length=1, alias="procedure"
    )
    limits: Mapping[Parameter, Limit] = Field(default_factory=dict)  # type: ignore[assignment]  # fewer keys

    @model_validator(mode="after")
    def _ends_one_day(self) -> "DividingHeadProgramme":
        check_ends(self.realisations * sum(part.poses for part in self.procedures))
        return self

    @property
    def parts(self) -> tuple[Flip | Sweep, ...]:
        """The procedures, in order."""
        return self.procedures

    def nominal(self, dwell: Dwell) -> Mapping[str, float]:
        """The voltage of a unit that gives 1 V/g along x and nothing else."""
        return {VOLTAGE: _nominal_voltage_v(dwell.conditions[MOUNT], dwell.targets_deg[HEAD])}


@lru_cache(maxsize=4096)
def _nominal_voltage_v(mount: str, angle_deg: float) -> float:
    """Of that unit; a programme comes back to its poses, and is planned again and again."""
    return float(projections([mount], np.array([angle_deg]))[0, 0])
