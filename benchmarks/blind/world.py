"""What the instruments say, without noise: the unit's equation, and the effects in the order in which they act."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np

from benchmarks.blind.geometry import FloatArray, projections
from benchmarks.blind.run import Run


@dataclass(frozen=True, kw_only=True)
class Unit:
    """Parameters of the declared model (domain.md, equations 1 and 12), in the contract's units."""

    u0: float
    kx: float
    ky: float
    kz: float
    kxy: float
    alpha0_deg: float

    def response_v(self, gravity: FloatArray) -> FloatArray:
        """U = u0 + kx ax + ky ay + kz az + kxy ax ay (domain.md, equation 1)."""
        ax, ay, az = gravity.T
        return np.asarray(self.u0 + self.kx * ax + self.ky * ay + self.kz * az + self.kxy * ax * ay)


class Acts(Enum):
    """On what an effect acts, and in which unit it says how much."""

    TILT = "deg, tilt of the head's axis"
    ANGLE = "deg, true angle less reported angle"
    OUTPUT = "V, added by the unit"
    READING = "V, added by the DAQ to what it is given"


@dataclass(frozen=True)
class World:
    """A run and a unit; what effects see."""

    run: Run
    unit: Unit
    angle_error_deg: FloatArray
    tilt_deg: FloatArray
    given_v: FloatArray
    """What the DAQ is given."""

    @cached_property
    def gravity(self) -> FloatArray:
        """(ax, ay, az) of each row."""
        return projections(
            self.run.mount, self.run.angle_deg + self.unit.alpha0_deg + self.angle_error_deg, self.tilt_deg
        )

    @property
    def ax(self) -> FloatArray:
        """Projection of gravity on the sensitive axis."""
        return self.gravity[:, 0]

    @property
    def ay(self) -> FloatArray:
        """Projection of gravity on the second axis."""
        return self.gravity[:, 1]

    @property
    def az(self) -> FloatArray:
        """Projection of gravity on the third axis."""
        return self.gravity[:, 2]


@dataclass(frozen=True, kw_only=True)
class Effect:
    """An effect in its size."""

    name: str
    acts: Acts
    amount: Callable[[World], FloatArray]
    coefficients: Mapping[str, Any]
    """Keys and units of effects.md."""


def respond_v(run: Run, unit: Unit, effects: Sequence[Effect] = ()) -> FloatArray:
    """Return the noise-free readings of a run, shape (rows,)."""
    none = np.zeros(len(run.time_s))
    world = World(run, unit, none, none, none)
    tilt_deg, error_deg = _sum(world, effects, Acts.TILT), _sum(world, effects, Acts.ANGLE)
    world = World(run, unit, error_deg, tilt_deg, none)
    given_v = unit.response_v(world.gravity) + _sum(world, effects, Acts.OUTPUT)
    return given_v + _sum(World(run, unit, error_deg, tilt_deg, given_v), effects, Acts.READING)


def _sum(world: World, effects: Sequence[Effect], acts: Acts) -> FloatArray:
    return sum((effect.amount(world) for effect in effects if effect.acts is acts), np.zeros(len(world.run.time_s)))
