"""Carrying out a procedure at a stand.

The engine takes steps from a procedure, has instruments and operator do what they ask for, and sends back what came of
it. It knows no procedure, no instrument and no recording; in whatever way a run ends, everything is brought to rest.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from functools import partial

from tumble.drivers.protocols import Identity, Stand
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.announcer import Announcer, Listener, Sink
from tumble.procedures.axes import Axes, Look, look_away
from tumble.procedures.composition import advance
from tumble.procedures.control import Control
from tumble.procedures.environments import Environments
from tumble.procedures.errors import ProcedureError, StorageError, UnansweredError
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    PointCompleted,
    RunResumed,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.exciters import Exciters
from tumble.procedures.interlock import Interlock
from tumble.procedures.journeys import POLL_S
from tumble.procedures.losses import Losses
from tumble.procedures.measuring import Measuring, Taken
from tumble.procedures.operator import Answer, Operator
from tumble.procedures.outcome import Outcome, message_of, outcome_of
from tumble.procedures.recovery import Recovery
from tumble.procedures.replay import replay
from tumble.procedures.sampling import Sampling
from tumble.procedures.second_look import SecondLook
from tumble.procedures.steps import Ask, Confirmed, Dwell, Point, Procedure, Reply, Step, pose
from tumble.procedures.verification import check_agreement, verified


class Engine:
    """Carries out one run.

    A pause or a stop that its `control` is asked for, from any thread, is heeded between steps, while a positioner
    moves and while the outputs settle; a stop also while the operator, a lost link or the answer of a sampler is
    awaited. Samples being taken are taken first, where a stop need not wait for them. A step in which a link is lost
    begins anew once it is back, see `Recovery`.

    Parameters
    ----------
    stand
        Instruments and clock.
    operator
        Who sets what no positioner can.
    sink
        Takes every event; the engine goes on only when a point is safe there.
    acquisition
        How each dwell is taken.
    listeners
        Called with every event that the sink has taken; one that raises is dropped.
    eyepiece
        The person who reads a positioner by eye, where the stand has one; looks again where a measurement contradicts
        a reading.
    control
        Pauses, resumes and stops the run; one of its own without it.
    look
        Called with the name of a positioner and what it reports on its way; must not raise.
    """

    def __init__(
        self,
        stand: Stand,
        operator: Operator,
        sink: Sink,
        acquisition: Acquisition,
        listeners: Iterable[Listener] = (),
        eyepiece: SecondLook | None = None,
        *,
        control: Control | None = None,
        look: Look = look_away,
    ) -> None:
        self._clock = stand.clock
        self._attention = stand.attention
        self._operator = operator
        self._announcer = Announcer(sink, listeners)
        self._acquisition = acquisition
        self.control = control or Control()
        """Pauses, resumes and stops the run; from any thread."""
        losses = Losses()
        self._axes = Axes(stand, acquisition, losses, look)
        sampling = Sampling(stand, losses)
        blocks = partial(sampling.blocks, acquisition.settle_samples, acquisition.rate_hz)
        self._exciters = Exciters(stand, losses, blocks, self.control.check)
        self._recovery = Recovery(
            stand, self._axes, self._exciters, losses, self._announcer.announce, self.control.check
        )
        self._interlock = Interlock(stand, losses)
        self._measuring = Measuring(
            stand, acquisition, self._axes, sampling, self._exciters, self._recovery, self._guarded
        )
        self._environments = Environments(stand, acquisition, sampling, self._recovery, losses, self.control.check)
        self._moving = " or ".join(map(stand.title, (*stand.positioners, *stand.exciters)))
        self._eyepiece = eyepiece
        if eyepiece is not None:
            eyepiece.attach(self._announcer.announce)
        self._points: list[Point] = []
        self._conditions: dict[str, str] = {}
        self._began_s = 0.0
        self._left_unsafe: list[str] = []
        self.state = State.IDLE
        """Where the run stands; only the engine changes it."""

    def run(self, procedure: Procedure) -> Outcome:
        """Carry out `procedure` to its end, or until something else ends it, and bring everything to a standstill."""
        self._began_s = self._clock.monotonic_s()
        return self._to_its_end(procedure, next(procedure, None), self._meet)

    def resume(
        self,
        procedure: Procedure,
        journal: Iterable[Reply],
        *,
        elapsed_s: Callable[[], float] = lambda: 0.0,
        known: Mapping[str, Identity] | None = None,
        tolerance_v: float | None = None,
    ) -> Outcome:
        """Go on with a run that was cut off, as `run` would have.

        The procedure is told of what was recorded as if it happened now. Before the next step the instruments are
        identified, the operator confirms the conditions of the last point, the positioners are homed, and that point is
        taken again to see whether the stand still measures the same.

        Parameters
        ----------
        journal
            What the run has recorded, in order.
        elapsed_s
            Seconds since the run began, asked when it goes on; at least the time of the last point is taken.
        known
            The instruments with which the run was begun, by name.
        tolerance_v
            By how much the means of the last point may differ; without it, by what noise explains.

        Raises
        ------
        JournalError
            Where `journal` is not the beginning of `procedure`; nothing has moved then.
        """
        replayed = replay(procedure, journal, self._replay_tolerance_deg)
        self._points = list(replayed.points)
        self._recovery.know(known or {})
        return self._to_its_end(
            procedure, replayed.pending, partial(self._go_on, replayed.asks, elapsed_s, tolerance_v)
        )

    @property
    def _replay_tolerance_deg(self) -> float:
        """What a person reads may differ by anything from what was to be set."""
        return math.inf if self._eyepiece else self._acquisition.position_tolerance_deg

    def _to_its_end(self, procedure: Procedure, step: Step | None, prepare: Callable[[], None]) -> Outcome:
        try:
            with self._attention.paid_to(self.control.check):  # and no longer: at the end nothing breaks a wait off
                self._carry_out(procedure, step, prepare)
        except (Exception, KeyboardInterrupt) as error:
            return self._finish(error)
        except BaseException as error:
            self._finish(error)
            raise
        return self._finish(None)

    def _meet(self) -> None:
        """Get to know all instruments, and bring to rest what a run that was killed has left driving."""
        self._recovery.begin()
        self._recovery.persist(self._exciters.begin)

    def _go_on(self, asks: Iterable[Ask], elapsed_s: Callable[[], float], tolerance_v: float | None) -> None:
        """Make sure that the stand is as it was, and let the run's time go on."""
        self._meet()
        last = self._points[-1] if self._points else None
        if last is not None:
            self._verify(last, asks, tolerance_v)
        self._announcer.announce(RunResumed(points=len(self._points)))
        self._began_s = self._clock.monotonic_s() - max(elapsed_s(), last.time_s if last else 0.0)

    def _carry_out(self, procedure: Procedure, step: Step | None, prepare: Callable[[], None]) -> None:
        self._change(State.RUNNING)
        if step is None:
            return
        self._checkpoint()
        prepare()
        self._recovery.persist(self._interlock.begin)
        self._recovery.reference()
        while step is not None:
            self._checkpoint()
            self._announcer.announce(StepStarted(step=step))
            reply = self._ask(step) if isinstance(step, Ask) else self._dwell(step)
            self._recovery.tell_remarks()
            step = advance(procedure, reply)
        self._measuring.unwind()

    def _ask(self, ask: Ask) -> Confirmed:
        self._change(State.AWAITING_OPERATOR)
        self._announcer.announce(ConditionRequested(condition=ask.condition, value=ask.value, prompt=ask.prompt))
        answer = self._set_by_itself(ask) or self._asked(ask)
        self._announcer.announce(
            ConditionAnswered(condition=ask.condition, value=ask.value, answer=answer.text, confirmed=answer.confirmed)
        )
        if not answer.confirmed:
            said = (
                Message("was answered {answer!r}", answer=answer.text) if answer.text else Message("was not answered")
            )
            raise UnansweredError(
                Message(
                    "the request to {task} {said}; {remedy} and resume the run",
                    task=ask.task,
                    said=said,
                    remedy=ask.remedy,
                )
            )
        self._conditions[ask.condition] = ask.value
        self._change(State.RUNNING)
        return Confirmed(condition=ask.condition, value=ask.value)

    def _set_by_itself(self, ask: Ask) -> Answer | None:
        """Have an environment or an exciter set a condition, in place of the operator; None where there is neither."""
        if ask.condition in self._environments.names:
            self._change(State.RUNNING)
            self._interlock.used.add(ask.condition)
            return Answer(text=self._environments.soak(ask.condition, float(ask.value)), confirmed=True)
        if ask.condition in self._exciters.names:
            self._change(State.RUNNING)
            excite = partial(self._exciters.excite, ask.condition, ask.value)
            return Answer(text=self._recovery.persist(excite), confirmed=True)
        return None

    def _asked(self, ask: Ask) -> Answer:
        """What the operator answers; nothing shakes what he may have to touch."""
        self._recovery.persist(self._exciters.clear)
        self._operator.ask(ask)
        while (answer := self._operator.poll()) is None:
            self.control.check()
            self._clock.sleep(POLL_S)
        return answer

    def _dwell(self, dwell: Dwell) -> Point:
        self._check_conditions(dwell)
        taken = self._measuring.measure(dwell)
        index = len(self._points)
        point = taken.point(dwell, index, self._began_s)
        for block in taken.blocks:
            self._announcer.announce(SamplesAcquired(point=index, time_s=taken.began_s - self._began_s, block=block))
        self._warn_of(taken, dwell)
        if self._eyepiece is not None:
            point = self._eyepiece.reconsidered(point, self._points, self.control.check)
        self._announcer.announce(PointCompleted(point=point))
        self._points.append(point)
        return point

    def _check_conditions(self, dwell: Dwell) -> None:
        for condition, value in dwell.conditions.items():
            if (standing := self._conditions.get(condition)) != value:
                raise ProcedureError(f"a dwell was asked for with the {condition} {value} while it is {standing}")

    def _warn_of(self, taken: Taken, dwell: Dwell) -> None:
        if taken.unusable:
            bad = Message(
                "{unusable} of {samples} samples are overloads or no numbers; the point will be set aside",
                unusable=taken.unusable,
                samples=taken.samples,
            )
            self._warn(dwell, bad)
        if not taken.settled:
            late = Message(
                "the output had not settled after {waited_s:g} s; the point is kept and marked",
                waited_s=self._acquisition.settle_timeout_s,
            )
            self._warn(dwell, late)

    def _verify(self, last: Point, asks: Iterable[Ask], tolerance_v: float | None) -> None:
        """Bring everything back to where `last` was taken, and see whether a point gives there what it gave."""
        for name, angle_deg in last.positions_deg.items():
            self._recovery.tell_of_winding(name, angle_deg)
        for ask in asks:
            self._ask(ask)
        self._measuring.home()
        now = self._measuring.measure_again(last).readings
        for seen in verified(self._points, now, self._acquisition.position_tolerance_deg, tolerance_v):
            self._announcer.announce(seen)
            check_agreement(seen)

    def _guarded(self) -> bool:
        """The same, while something turns: only behind doors that are shut."""
        self._interlock.check()
        return self._checkpoint()

    def _checkpoint(self) -> bool:
        """Stop or pause here where that is wanted; true where the run was paused, and everything stood for it."""
        self.control.check()
        if not self.control.pause_wanted():
            return False
        self._axes.halt()
        self._exciters.clear()
        self._change(State.PAUSED)
        while self.control.pause_wanted():
            self.control.check()
            self._clock.sleep(POLL_S)
        self._change(State.RUNNING)
        return True

    def _finish(self, error: BaseException | None) -> Outcome:
        """Bring all to a standstill, then tell everybody, the sink too, even where it was the sink that failed."""
        self.state = State.STOPPING
        with suppress(Exception):  # first of all; `standstill` sees whether it helped, and says it again
            self._axes.brake()
        self._change_anyway(State.STOPPING, message_of(error))
        at_standstill = False
        with suppress(KeyboardInterrupt):  # from whoever runs the engine without handling signals
            driving = self._exciters.leave()
            at_standstill = self._axes.standstill() and not driving
            self._left_unsafe = [*driving, *self._interlock.leave(at_standstill)]
        if at_standstill:
            self._change_anyway(State.STANDSTILL, message_of(error))
        for remark in (*self._left_unsafe, *self._recovery.last_remarks()):
            self._announcer.announce_anyway(WarningRaised(message=remark))
        outcome = outcome_of(error, self._points, at_standstill, self._moving)
        try:
            self._announcer.store(outcome.finished)
        except StorageError as failure:
            outcome = outcome_of(error or failure, self._points, at_standstill, self._moving)
        self._announcer.tell(outcome.finished)
        return outcome

    def _change(self, state: State) -> None:
        self.state = state
        self._announcer.announce(StateChanged(state=state))

    def _change_anyway(self, state: State, reason: str) -> None:
        self.state = state
        self._announcer.announce_anyway(StateChanged(state=state, reason=reason))

    def _warn(self, dwell: Dwell, message: str) -> None:
        said = Message(
            "point {index} ({pose}): {message}",
            index=len(self._points),
            pose=pose(dwell.conditions, dwell.targets_deg),
            message=message,
        )
        self._announcer.announce(WarningRaised(message=said))
