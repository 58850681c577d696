"""180° flip tests: the unit's axis down and up, in turn.

Avrutov, Bondar, Meleshko 2008, equations 2 to 11: half the difference of the two outputs is the axis' scale factor,
their mean the bias. For the x axis, where the output passes an extremum near either pole, the extremum can be sought in
place of trusting the nominal angle; at the poles of y and z there is none.
"""

from collections.abc import Generator
from typing import Literal, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from tumble.calibrations.methods.dividing_head.flips import POLES, SEEKING_DEG
from tumble.messages import Message
from tumble.procedures.composition import Dwells
from tumble.procedures.methods.dividing_head.layout import dwell_at
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.steps import Dwell, Point

Axis: TypeAlias = Literal["x", "y", "z"]


class Flip(BaseModel):
    """Flips of one or more axes, in the order given: each one down, then up."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    kind: Literal["flip"]
    axes: tuple[Axis, ...] = Field(min_length=1)
    pole: Literal["nominal", "extremum"] = "nominal"
    """`extremum` seeks the extremum at the two x poles; y and z are always taken at their nominal angles."""
    span_deg: float = Field(default=10.0, gt=0.0, le=SEEKING_DEG)
    """How far from the nominal x pole the extremum is sought, in degrees to either side."""

    @field_validator("axes")
    @classmethod
    def _each_once(cls, axes: tuple[Axis, ...]) -> tuple[Axis, ...]:
        if len(set(axes)) < len(axes):
            raise ValueError(Message("an axis is named twice"))
        return axes

    @model_validator(mode="after")
    def _has_an_extremum(self) -> "Flip":
        if self.pole == "extremum" and "x" not in self.axes:
            raise ValueError(Message('pole = "extremum" needs the x axis, the only one with an extremum at its poles'))
        return self

    @property
    def poses(self) -> int:
        """Number of different poses, those of seeking an extremum apart."""
        return 2 * len(self.axes)

    def dwells(self, realisation: int) -> Dwells:
        """Carry out the flips once."""
        for axis in self.axes:
            mount, *poles_deg = POLES[axis]
            for nominal_deg in poles_deg:
                angle_deg = nominal_deg
                if axis == "x" and self.pole == "extremum":
                    angle_deg = yield from _seek(nominal_deg, self.span_deg, realisation, mount)
                yield dwell_at(angle_deg=angle_deg, procedure="flip", realisation=realisation, mount=mount)


def _seek(nominal_deg: float, span_deg: float, realisation: int, mount: str) -> Generator[Dwell, Point, float]:
    """Look for the extremum of the output in two rounds of three dwells; return its head angle in degrees.

    The first round looks at the nominal pole and one span to either side of it, the second at the extremum seen in the
    first and half a span to either side. No dwell lies outside `nominal_deg` ± `span_deg`.
    """
    seen: list[Point] = []
    centre_deg = nominal_deg
    for reach_deg in (span_deg, span_deg / 2):
        for offset_deg in (-reach_deg, 0.0, reach_deg):
            angle_deg = _clamp(centre_deg + offset_deg, nominal_deg, span_deg)
            seen.append((yield dwell_at(angle_deg=angle_deg, procedure="seek", realisation=realisation, mount=mount)))
        centre_deg = extremum_deg(seen, nominal_deg, span_deg)
    return centre_deg


def extremum_deg(points: list[Point], nominal_deg: float, span_deg: float) -> float:
    """Head angle of the extremum of `c + s sin φ + k cos φ` through the points that lies next to the nominal pole.

    It is clamped to `nominal_deg` ± `span_deg`, however noisy the points are; with fewer than three different usable
    points it is `nominal_deg` itself. Points whose voltage is not finite are passed over.
    """
    usable = [row for row in map(row_of, points) if np.isfinite(row.voltage_v)]
    offset_rad = np.deg2rad([row.angle_deg - nominal_deg for row in usable])
    design = np.stack([np.ones_like(offset_rad), np.sin(offset_rad), np.cos(offset_rad)], axis=-1)
    (_, sine, cosine), _, rank, _ = np.linalg.lstsq(design, np.array([row.voltage_v for row in usable]), rcond=None)
    if rank < 3:
        return nominal_deg
    # Extremum and its opposite are equally good solutions: the one within 90° of the pole is meant.
    offset_deg = (np.rad2deg(np.arctan2(sine, cosine)) + 90.0) % 180.0 - 90.0
    return _clamp(nominal_deg + float(offset_deg), nominal_deg, span_deg)


def _clamp(angle_deg: float, nominal_deg: float, span_deg: float) -> float:
    return min(max(angle_deg, nominal_deg - span_deg), nominal_deg + span_deg)
