"""What a procedure asks of the stand, and what it gets back.

A procedure is a generator: it yields steps and is sent what came of each. Steps are frozen data, so that a recording
can hold them and a resumed run can compare them.
"""

from collections.abc import Generator
from dataclasses import dataclass
from typing import Literal, TypeAlias

Direction: TypeAlias = Literal[-1, 0, 1]


@dataclass(frozen=True, kw_only=True)
class Mounting:
    """Ask the operator to seat the unit in another mount. The reply is a `Mounted`."""

    mount: str
    """Name of the mount, a key of `tumble.calibrations.methods.dividing_head.geometry.MOUNTS`."""


@dataclass(frozen=True, kw_only=True)
class Dwell:
    """Turn the head, wait until the output has settled, acquire. The reply is a `Point`."""

    angle_deg: float
    """Head angle to go to, in degrees; any revolution."""
    procedure: str
    """What the dwell belongs to: `flip`, `seek`, `sweep`."""
    realisation: int
    """Which repeat it belongs to, from 1."""
    mount: str
    """Mount in which the unit must sit."""


Step: TypeAlias = Mounting | Dwell


@dataclass(frozen=True, kw_only=True)
class Mounted:
    """The operator has confirmed that the unit sits in `mount`."""

    mount: str


@dataclass(frozen=True, kw_only=True)
class Point:
    """A dwell, reduced: one row of the observation table."""

    index: int
    """Number of the point in the run, from 0."""
    angle_deg: float
    """Head angle as the head reported it, in degrees."""
    voltage_v: float
    """Mean output over the dwell, in volts."""
    voltage_sd_v: float
    """Standard deviation of the single samples (divisor n - 1), in volts."""
    samples: int
    """Number of samples in the mean."""
    time_s: float
    """Middle of the dwell, in seconds since the run began, by the stand's clock."""
    direction: Direction
    """Sign of the last move of the head; 0 before the first."""
    temperature_degc: float | None
    realisation: int
    procedure: str
    mount: str
    settled: bool
    """False where the output was still moving when the time allowed for settling was over."""


Reply: TypeAlias = Mounted | Point
Procedure: TypeAlias = Generator[Step, Reply, None]
"""Yields steps, is sent the reply to each."""
