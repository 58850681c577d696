"""How far a run is, and when it will be done.

The time a step takes is modelled as `actual = r planned + error` with the variance of the error proportional to the
planned time, `s² planned`. Weighted least squares through the origin then gives (Cochran, Sampling Techniques, 1977,
chapter 6, ratio estimators), over the n steps done:

    r  = Σ actual / Σ planned
    s² = Σ (actual - r planned)² / planned / (n - 1)

and for what is left, with R the sum of its planned times,

    time left = r R,   variance = s² R + s² R² / Σ planned

The first term of the variance is the scatter of the steps to come, the second what is not known of r. Requests and
dwells are kept apart, since people and machines are late for different reasons. Before the first step of a kind r is 1,
and before the second the standard error of the time left is that time itself.
"""

import math
from collections import deque
from dataclasses import dataclass

from tumble.drivers.clock import Clock
from tumble.procedures.events import (
    ConditionAnswered,
    Event,
    PointCompleted,
    RetakeBegun,
    State,
    StateChanged,
    StepStarted,
)
from tumble.procedures.plan import Plan
from tumble.procedures.steps import Ask, Dwell


@dataclass(frozen=True, kw_only=True)
class TimeLeft:
    """An estimate of the time until a run is done, in seconds."""

    time_s: float
    standard_error_s: float


class Progress:
    """A listener that keeps count. Pauses do not count as time that a step took.

    Parameters
    ----------
    plan
        What the run shall do.
    clock
        The stand's clock.
    points_done
        Points that were there already when the run was resumed.
    """

    def __init__(self, plan: Plan, clock: Clock, points_done: int = 0) -> None:
        self.total = plan.dwells
        """Number of points of the whole run."""
        self.done = points_done
        """Number of points that are there."""
        self._clock, self._plan = clock, plan
        self._left = deque(plan.steps_after(points_done))
        self._paces = {Dwell: _Pace(), Ask: _Pace()}
        self._began_s: float | None = None
        self._taking_again = False
        """Whether what happens belongs to a point that is there already: no step of the programme."""
        self._pause_began_s: float | None = None
        self._paused_s = 0.0

    def __call__(self, event: Event) -> None:
        """Take note of an event."""
        match event:
            case RetakeBegun():
                self._taking_again, self._began_s = True, None
                self._left = deque(self._plan.steps_after(self.done))  # a mount that was set since is asked for anew
            case StepStarted() if self._taking_again:
                pass
            case PointCompleted() if self._taking_again:
                self._taking_again = False
            case StepStarted():
                self._began_s = self._working_s()
            case ConditionAnswered(confirmed=True):
                self._step_done()
            case PointCompleted():
                self.done += 1
                self._step_done()
            case StateChanged(state=State.PAUSED):
                self._pause_began_s = self._clock.monotonic_s()
            case StateChanged(state=State.RUNNING) if self._pause_began_s is not None:
                self._paused_s += self._clock.monotonic_s() - self._pause_began_s
                self._pause_began_s = None

    def time_left(self) -> TimeLeft:
        """Estimate the time that the steps not yet done will take."""
        estimates = [
            pace.time_left(sum(planned.duration_s for planned in self._left if isinstance(planned.step, kind)))
            for kind, pace in self._paces.items()
        ]
        return TimeLeft(
            time_s=sum(estimate.time_s for estimate in estimates),
            standard_error_s=math.hypot(*(estimate.standard_error_s for estimate in estimates)),
        )

    def _step_done(self) -> None:
        if self._began_s is None:  # a mount that is confirmed again: no step of the programme
            return
        if not self._left:
            return  # a run that has more steps than were planned: its time is not known
        planned = self._left.popleft()
        self._paces[type(planned.step)].add(planned.duration_s, self._working_s() - self._began_s)
        self._began_s = None

    def _working_s(self) -> float:
        return self._clock.monotonic_s() - self._paused_s


@dataclass(kw_only=True)
class _Pace:
    """Sums over the steps of one kind that are done."""

    steps: int = 0
    planned_s: float = 0.0
    actual_s: float = 0.0
    squares_s: float = 0.0
    """Sum of actual² / planned."""

    def add(self, planned_s: float, actual_s: float) -> None:
        """Count a step; one that was planned to take no time says nothing."""
        if planned_s > 0:
            self.steps += 1
            self.planned_s += planned_s
            self.actual_s += actual_s
            self.squares_s += actual_s**2 / planned_s

    def time_left(self, planned_s: float) -> TimeLeft:
        """Estimate how long steps take that are planned to take `planned_s` together."""
        ratio = self.actual_s / self.planned_s if self.steps else 1.0
        time_s = ratio * planned_s
        if self.steps < 2:
            return TimeLeft(time_s=time_s, standard_error_s=time_s)
        scatter_s = max(0.0, self.squares_s - ratio * self.actual_s) / (self.steps - 1)
        variance_s2 = scatter_s * (planned_s + planned_s**2 / self.planned_s)
        return TimeLeft(time_s=time_s, standard_error_s=math.sqrt(variance_s2))
