"""The end of a run, whatever ended it: a standstill that was read back, and that everybody is told."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from tumble.procedures.announcer import Announcer
from tumble.procedures.axes import Axes
from tumble.procedures.errors import StorageError
from tumble.procedures.events import State, WarningRaised
from tumble.procedures.exciters import Exciters
from tumble.procedures.interlock import Interlock
from tumble.procedures.outcome import Outcome, message_of, outcome_of
from tumble.procedures.phase import Phase
from tumble.procedures.recovery import Recovery
from tumble.procedures.steps import Point


@dataclass(frozen=True, kw_only=True)
class Ending:
    """Brings everything to a standstill, then tells everybody, the sink too, even where it was the sink that failed."""

    axes: Axes
    exciters: Exciters
    interlock: Interlock
    recovery: Recovery
    announcer: Announcer
    phase: Phase
    moving: str
    """What may be left moving, by its title."""

    def of(self, error: BaseException | None, points: Sequence[Point]) -> Outcome:
        """End a run that took `points`, and that `error` ended, or nothing but its procedure."""
        self.phase.state = State.STOPPING
        with suppress(Exception):  # first of all; `standstill` sees whether it helped, and says it again
            self.axes.brake()
        self.phase.change_anyway(State.STOPPING, message_of(error))
        at_standstill, left_unsafe = False, list[str]()
        with suppress(KeyboardInterrupt):  # from whoever runs the engine without handling signals
            driving = self.exciters.leave()
            at_standstill = self.axes.standstill() and not driving
            left_unsafe = [*driving, *self.interlock.leave(at_standstill)]
        if at_standstill:
            self.phase.change_anyway(State.STANDSTILL, message_of(error))
        for remark in (*left_unsafe, *self.recovery.last_remarks()):
            self.announcer.announce_anyway(WarningRaised(message=remark))
        return self._told(error, points, at_standstill)

    def _told(self, error: BaseException | None, points: Sequence[Point], at_standstill: bool) -> Outcome:
        outcome = outcome_of(error, points, at_standstill, self.moving)
        try:
            self.announcer.store(outcome.finished)
        except StorageError as failure:
            outcome = outcome_of(error or failure, points, at_standstill, self.moving)
        self.announcer.tell(outcome.finished)
        return outcome
