"""Where a run stands, and what may be said of that."""

from collections.abc import Collection
from dataclasses import dataclass, field
from enum import Enum, StrEnum, auto

from tumble.procedures.events import State
from tumble.window.look.language import tr
from tumble.window.look.sentences import state_name


class Mood(StrEnum):
    """What a state means to whoever sees it from afar; each has a colour."""

    READY = "ready"
    MEASURING = "measuring"
    WAITING = "waiting"
    """For the person at the stand."""
    PAUSED = "paused"
    FAULT = "fault"


class Phase(Enum):
    """What the screen is busy with."""

    IDLE = auto()
    RUNNING = auto()
    CONCLUDING = auto()
    """The head stands; what was measured is analysed and stored."""


@dataclass
class RunState:
    """What is known; that the head stands is said only where that was read back."""

    running: bool = False
    """Whether a run has the stand."""
    at_work: bool = False
    """Whether the stand carries out an order: a run, or a move by hand, or connecting."""
    halting: bool = False
    """Whether that is told to stop."""
    concluding: int = 0
    """Runs that are over and have no result yet."""
    changing_unit: bool = False
    """Whether the next unit is to be put on the stand before anything goes on."""
    stopped: bool = False
    """Whether a run ended before its time here, and nobody has said yet what is to become of it."""
    faulty: bool = False
    """Whether a fault ended it, and nobody that stopped it."""
    state: State = State.IDLE
    pausing: bool = False
    """Whether a pause was asked for that has not begun."""
    restless: bool = False
    """Whether the standstill of a positioner could not be read back."""
    last: int = -1
    """Number of the last point that is there, from 0; -1 before the first."""
    repeating: bool = False
    """Whether it is to be taken again, as was asked for."""
    reading: bool = False
    """Whether a reading of the head is awaited."""
    resting: set[str] = field(default_factory=set)
    """Positioners that were seen at rest since then, by name."""

    @property
    def phase(self) -> Phase:
        """What the screen is busy with, the stand first."""
        if self.running:
            return Phase.RUNNING
        return Phase.CONCLUDING if self.concluding else Phase.IDLE

    @property
    def paused(self) -> bool:
        """Whether the head stands for a pause."""
        return self.running and self.state is State.PAUSED

    @property
    def repeatable(self) -> bool:
        """Whether the last point can be taken again."""
        ending = self.state in (State.STOPPING, State.STANDSTILL)
        return self.running and not ending and self.last >= 0 and not self.repeating

    @property
    def waiting(self) -> bool:
        """Whether nothing goes on before the person at the stand has done something."""
        asked = self.reading and self.state is State.RUNNING
        return self.changing_unit or (self.running and (asked or self.state is State.AWAITING_OPERATOR))

    @property
    def is_over(self) -> bool:
        """Whether nothing goes on, and nobody is asked for anything."""
        return self.phase is Phase.IDLE and not self.waiting

    def change(self, state: State) -> None:
        """Take over what the engine tells."""
        self.state = state
        self.pausing = self.pausing and state is not State.PAUSED

    def complete(self, point: int) -> None:
        """A point is there."""
        self.last, self.repeating = point, False

    def settle(self, at_standstill: bool) -> None:
        """Something ended, and the standstill of the stand was read back or was not."""
        self.restless, self.resting = not at_standstill, set()

    def see(self, name: str, moving: bool, positioners: Collection[str]) -> None:
        """A positioner was seen; whatever was restless is at rest once every one of the stand was seen so."""
        self.resting = self.resting - {name} if moving else self.resting | {name}
        if self.resting.issuperset(positioners):
            self.restless = False

    def begin(self, points: int) -> None:
        """A run has the stand, of which so many points are there."""
        self.last, self.repeating = points - 1, False
        self.running, self.changing_unit, self.stopped, self.faulty = True, False, False, False

    def end(self) -> None:
        """The run is over."""
        self.running, self.state = False, State.IDLE
        self.pausing = self.reading = self.repeating = False

    @property
    def text(self) -> str:
        """In a word or two."""
        if self.restless:
            return tr("Fault: the standstill was not read back")
        if self.phase is Phase.CONCLUDING and not self.waiting:
            return tr("Analysing")
        if self.pausing:
            return tr("Waits for you, and pauses then") if self.waiting else tr("Pausing…")
        if self.stopped and self.phase is Phase.IDLE and not self.waiting:
            return tr("Stopped by a fault") if self.faulty else tr("Stopped")
        return self._going_on

    @property
    def _going_on(self) -> str:
        """What a run does that neither ends nor is about to pause."""
        if self.repeating and not self.waiting:
            return tr("Paused; then the last point again") if self.paused else tr("Taking the last point again")
        if self.running and self.state is State.IDLE:
            return tr("Getting ready")
        if self.at_work and not (self.running or self.waiting):
            return state_name(State.STOPPING) if self.halting else tr("At work")
        return state_name(State.AWAITING_OPERATOR if self.waiting else self.state)

    @property
    def mood(self) -> Mood:
        """What that means."""
        if self.restless:
            return Mood.FAULT
        if self.waiting:
            return Mood.WAITING
        if self.stopped and self.faulty and self.phase is Phase.IDLE:
            return Mood.FAULT
        if self.paused or self.pausing or (self.stopped and self.phase is Phase.IDLE):
            return Mood.PAUSED
        return Mood.READY if self.phase is Phase.IDLE and not self.at_work else Mood.MEASURING
