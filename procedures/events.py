"""What the engine announces while it runs, and the states it can be in."""

from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

from tumble.drivers.protocols import Block
from tumble.messages import translatable
from tumble.procedures.steps import Point, Step


class State(StrEnum):
    """Where a run stands.

    `IDLE → RUNNING ⇄ PAUSED`, `RUNNING ⇄ AWAITING_OPERATOR`, and from each of these `→ STOPPING → STANDSTILL`. A run
    always ends in `STANDSTILL`: the head was told to stop and its rest was read back.
    """

    IDLE = "idle"
    RUNNING = "running"
    PAUSED = "paused"
    AWAITING_OPERATOR = "awaiting operator"
    STOPPING = "stopping"
    STANDSTILL = "standstill"


class FinishReason(StrEnum):
    """Why a run ended."""

    COMPLETED = translatable("completed")
    STOPPED = translatable("stopped by the operator")
    UNANSWERED = translatable("a prompt was not answered")
    DEVICE_FAULT = translatable("device fault")
    STORAGE = translatable("the recording could not be written")
    INTERNAL = translatable("a fault of the program")


@dataclass(frozen=True, kw_only=True)
class StateChanged:
    """The run went over into another state."""

    state: State
    reason: str = ""


@dataclass(frozen=True, kw_only=True)
class Identified:
    """An instrument said who it is; `instrument` is its name at the stand."""

    instrument: str
    model: str
    serial: str
    firmware: str


@dataclass(frozen=True, kw_only=True)
class PointVerified:
    """After an interruption a point was taken again, and a channel compared; the point itself stays as it was."""

    point: int
    channel: str
    now: float
    """What was measured now, in the unit of the channel."""
    recorded: float
    allowed: float
    """By how much the two may differ."""


@dataclass(frozen=True, kw_only=True)
class RunResumed:
    """A run that was cut off goes on, with so many points done."""

    points: int


@dataclass(frozen=True, kw_only=True)
class RetakeBegun:
    """The last point is measured once more, as the operator wishes; its dwell is the step that comes next."""

    point: int


@dataclass(frozen=True, kw_only=True)
class StepStarted:
    """The engine begins to carry out a step."""

    step: Step


@dataclass(frozen=True, kw_only=True)
class ConditionRequested:
    """The operator is asked to set a condition; the run waits."""

    condition: str
    value: str
    prompt: str


@dataclass(frozen=True, kw_only=True)
class ConditionAnswered:
    """The operator's answer to such a request, word for word."""

    condition: str
    value: str
    answer: str
    confirmed: bool


@dataclass(frozen=True, kw_only=True)
class ReadingRequested:
    """The operator is asked to set a positioner by hand and to read it, or to look again."""

    setting_deg: float
    prompt: str


@dataclass(frozen=True, kw_only=True)
class ReadingAnswered:
    """What the operator typed as the reading of a positioner that is set by hand, word for word."""

    setting_deg: float
    answer: str
    reading_deg: float
    """The answer as an angle; NaN where it is none."""


@dataclass(frozen=True, kw_only=True)
class SamplesAcquired:
    """The raw samples of a dwell, before they are reduced."""

    point: int
    """Index of the point to which they belong."""
    time_s: float
    """First sample, in seconds since the run began, by the stand's clock."""
    block: Block
    take: int = 1
    """Which taking of the point, from 1."""


@dataclass(frozen=True, kw_only=True)
class PointCompleted:
    """A dwell was reduced and is on the disk; a point that was taken again is there in the place of the one before."""

    point: Point


@dataclass(frozen=True, kw_only=True)
class WarningRaised:
    """Something the reader of the result should know."""

    message: str


@dataclass(frozen=True, kw_only=True)
class RunFinished:
    """The run is over; the head stands still unless `at_standstill` is false."""

    reason: FinishReason
    message: str
    at_standstill: bool


Event: TypeAlias = (
    StateChanged
    | Identified
    | PointVerified
    | RunResumed
    | RetakeBegun
    | StepStarted
    | ConditionRequested
    | ConditionAnswered
    | ReadingRequested
    | ReadingAnswered
    | SamplesAcquired
    | PointCompleted
    | WarningRaised
    | RunFinished
)
