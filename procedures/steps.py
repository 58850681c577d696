"""What a procedure asks of the stand, and what it gets back.

A procedure is a generator: it yields steps and is sent what came of each. Steps are frozen data, so that a recording
can hold them and a resumed run can compare them. Positioners, channels and conditions go by the names that stand and
method give them; see `tumble.procedures.layout`.
"""

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from tumble.messages import Message

Direction: TypeAlias = Literal[-1, 0, 1]


@dataclass(frozen=True, kw_only=True)
class Ask:
    """Ask the operator to set a condition that no positioner can. The reply is a `Confirmed`."""

    condition: str
    """Name of the condition, for example `mount`."""
    value: str
    """What it shall be; to be answered with this word or with yes."""
    task: str
    """What the operator has to do, in the imperative: `seat the unit in edge`."""
    remedy: str
    """The same in short, for a run that ended because it was not done: `seat it`."""
    prompt: str
    """The whole question, as it is shown."""
    hint: str
    """What may be typed, shown after an answer that says nothing clear."""


@dataclass(frozen=True, kw_only=True)
class Dwell:
    """Set all targets at once, wait until the outputs have settled, acquire. The reply is a `Point`."""

    targets_deg: Mapping[str, float]
    """Where to go, in degrees, by positioner; one that is not named stays where it is."""
    channels: tuple[str, ...]
    """What must be measured; the names carry the units."""
    procedure: str
    """What the dwell belongs to, for example `sweep`."""
    realisation: int
    """Which repeat it belongs to, from 1."""
    conditions: Mapping[str, str] = field(default_factory=dict)
    """What must have been asked for and confirmed before, by condition."""
    further: tuple[str, ...] = ()
    """What is measured besides where the stand has it."""


Step: TypeAlias = Ask | Dwell


@dataclass(frozen=True, kw_only=True)
class Confirmed:
    """The operator has confirmed that a condition is set."""

    condition: str
    value: str


@dataclass(frozen=True, kw_only=True)
class Reading:
    """Samples of one channel, reduced; in the channel's unit."""

    mean: float
    """NaN where a sample was unusable."""
    sd: float
    """Standard deviation of the single samples (divisor n - 1)."""
    samples: int
    """Number of samples in the mean."""
    temperature_degc: float | None = None
    """By a thermometer of the channel's own, where it has one."""


@dataclass(frozen=True, kw_only=True)
class Point:
    """A dwell, reduced: one row of an observation table."""

    index: int
    """Number of the point in the run, from 0."""
    positions_deg: Mapping[str, float]
    """As every positioner of the dwell reported it, in degrees."""
    directions: Mapping[str, Direction]
    """Sign of the last move of each of them; 0 before the first."""
    readings: Mapping[str, Reading]
    """By channel."""
    time_s: float
    """Middle of the dwell, in seconds since the run began, by the stand's clock."""
    temperature_degc: float | None
    procedure: str
    realisation: int
    conditions: Mapping[str, str] = field(default_factory=dict)
    settled: bool
    """False where an output was still moving when the time allowed for settling was over."""
    take: int = 1
    """Which taking of the dwell, from 1; more where the operator had it taken again."""


Reply: TypeAlias = Confirmed | Point

Procedure: TypeAlias = Generator[Step, Reply, None]
"""Yields steps, is sent the reply to each."""

Beginning: TypeAlias = Callable[[], Procedure]
"""A procedure at its beginning, anew with every call."""


def pose(conditions: Mapping[str, str], positions_deg: Mapping[str, float], unit: str = " deg") -> str:
    """Where a dwell is taken, for a sentence: `face-up at 30 deg`, or `outer 90 deg, inner 45 deg`."""
    angles = {name: Message.marked(f"{{angle_deg:g}}{unit}", angle_deg=angle) for name, angle in positions_deg.items()}
    named = len(angles) > 1
    places = [Message("{name} {angle}", name=name, angle=angle) if named else angle for name, angle in angles.items()]
    place = Message.joined(", ", places) if places else ""
    condition = ", ".join(conditions.values())
    if condition and place:
        return Message("{condition} at {place}", condition=condition, place=place)
    return condition or place
