"""A sweep: even steps of the head through one mount (Avrutov, Bondar, Meleshko 2008: 80 steps of 5°)."""

from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.messages import Message
from tumble.procedures.composition import Dwells
from tumble.procedures.methods.dividing_head.layout import dwell_at


def _known_mount(mount: str) -> str:
    if mount not in MOUNTS:
        raise ValueError(
            Message("{mount!r} is no mount; the mounts are {mounts}", mount=mount, mounts=", ".join(MOUNTS))
        )
    return mount


class Sweep(BaseModel):
    """Dwells at `start_deg`, `start_deg + step_deg`, …: `points` different angles."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    kind: Literal["sweep"]
    mount: Annotated[str, AfterValidator(_known_mount)] = "face-up"
    start_deg: float = 0.0
    step_deg: float
    points: int = Field(ge=1, le=100_000)
    order: Literal["up", "there-and-back", "shuffled"] = "up"
    seed: int = Field(default=0, ge=0)
    """Seed of the order `shuffled`; the others do not use it."""

    @property
    def poses(self) -> int:
        """Number of different poses."""
        return self.points

    def angles_deg(self, realisation: int) -> list[float]:
        """Head angles in the order in which they are taken, in degrees.

        `there-and-back` takes the turning point once: 80 points make 159 dwells. `shuffled` takes the permutation
        `numpy.random.default_rng(seed + realisation).permutation(points)`, so that every realisation has its own order
        and a repeated programme the same one.
        """
        rising = [self.start_deg + self.step_deg * number for number in range(self.points)]
        match self.order:
            case "up":
                return rising
            case "there-and-back":
                return rising + rising[-2::-1]
            case "shuffled":
                generator = np.random.default_rng(self.seed + realisation)
                return [rising[number] for number in generator.permutation(self.points)]

    def dwells(self, realisation: int) -> Dwells:
        """Carry out the sweep once."""
        for angle_deg in self.angles_deg(realisation):
            yield dwell_at(angle_deg=angle_deg, procedure="sweep", realisation=realisation, mount=self.mount)
