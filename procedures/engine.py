"""Carrying out a procedure at a stand.

The engine takes steps from a procedure, has head, DAQ and operator do what they ask for, and sends back what came of
it. It knows no procedure, no instrument and no recording; in whatever way a run ends, the head is brought to rest.
"""

from collections.abc import Iterable
from contextlib import suppress

from drivers.protocols import SampleBlock, Stand
from procedures.acquisition import Acquisition
from procedures.announcer import Announcer, Listener, Sink
from procedures.composition import advance
from procedures.control import Control
from procedures.errors import ProcedureError, StorageError, UnansweredError
from procedures.events import (
    MountAnswered,
    MountRequested,
    PointCompleted,
    SamplesAcquired,
    State,
    StateChanged,
    StepStarted,
    WarningRaised,
)
from procedures.motion import POLL_S, Motion
from procedures.operator import Answer, Operator
from procedures.outcome import Outcome, message_of, outcome_of
from procedures.reduction import reduce_block
from procedures.replay import Replayed, replay
from procedures.settling import acquire, settle
from procedures.steps import Dwell, Mounted, Mounting, Point, Procedure, Reply, Step


class Engine:
    """Carries out one run.

    A pause or a stop that its `control` is asked for, from any thread, is heeded between steps, while the head moves
    and while the output settles; a stop also while the operator is awaited. Samples being taken are taken first.

    Parameters
    ----------
    stand
        Head, DAQ and clock.
    operator
        Who seats the unit.
    sink
        Takes every event; the engine goes on only when a point is safe there.
    acquisition
        How each dwell is taken.
    listeners
        Called with every event that the sink has taken; one that raises is dropped.
    """

    def __init__(
        self,
        stand: Stand,
        operator: Operator,
        sink: Sink,
        acquisition: Acquisition,
        listeners: Iterable[Listener] = (),
    ) -> None:
        self._stand = stand
        self._clock = stand.clock
        self._operator = operator
        self._announcer = Announcer(sink, listeners)
        self._acquisition = acquisition
        self._motion = Motion(stand.head, stand.clock, acquisition.position_tolerance_deg)
        self._points: list[Point] = []
        self._seated: str | None = None
        self._began_s = 0.0
        self.state = State.IDLE
        """Where the run stands; only the engine changes it."""
        self.control = Control()
        """Pauses, resumes and stops the run; from any thread."""

    def run(self, procedure: Procedure, journal: Iterable[Reply] = (), elapsed_s: float = 0.0) -> Outcome:
        """Carry out `procedure` to its end, or until something else ends it, and bring the head to a standstill.

        Parameters
        ----------
        journal
            What a run that was cut off has recorded, in order. The procedure is told of it as if it happened now, and
            the run goes on after the last point, once the operator has confirmed the mount.
        elapsed_s
            Seconds since the run began, where it is resumed; at least the time of the last point is taken.

        Raises
        ------
        JournalError
            Where `journal` is not the beginning of `procedure`; nothing has moved then.
        """
        replayed = replay(procedure, journal, self._acquisition.position_tolerance_deg)
        self._continue_from(replayed, elapsed_s)
        try:
            self._carry_out(procedure, replayed.pending)
        except (Exception, KeyboardInterrupt) as error:
            return self._finish(error)
        except BaseException as error:
            self._finish(error)
            raise
        return self._finish(None)

    def _continue_from(self, replayed: Replayed, elapsed_s: float) -> None:
        self._points = list(replayed.points)
        if self._points:
            elapsed_s = max(elapsed_s, self._points[-1].time_s)
            self._motion.direction = self._points[-1].direction
        self._began_s = self._clock.monotonic_s() - elapsed_s

    def _carry_out(self, procedure: Procedure, step: Step | None) -> None:
        self._change(State.RUNNING)
        if self._points and isinstance(step, Dwell):
            self._seat(Mounting(mount=step.mount))
        while step is not None:
            self._checkpoint()
            self._announcer.announce(StepStarted(step=step))
            reply = self._seat(step) if isinstance(step, Mounting) else self._dwell(step)
            step = advance(procedure, reply)

    def _seat(self, mounting: Mounting) -> Mounted:
        mount = mounting.mount
        prompt = f"Seat the unit in the mount {mount}; answer {mount} or yes when it sits there."
        self._change(State.AWAITING_OPERATOR)
        self._announcer.announce(MountRequested(mount=mount, prompt=prompt))
        self._operator.ask_mount(mount, prompt)
        answer = self._await_answer()
        self._announcer.announce(MountAnswered(mount=mount, answer=answer.text, confirmed=answer.confirmed))
        if not answer.confirmed:
            said = f"was answered {answer.text!r}" if answer.text else "was not answered"
            raise UnansweredError(f"the request to seat the unit in {mount} {said}; seat it and resume the run")
        self._seated = mount
        self._change(State.RUNNING)
        return Mounted(mount=mount)

    def _await_answer(self) -> Answer:
        while (answer := self._operator.poll()) is None:
            self.control.check()
            self._clock.sleep(POLL_S)
        return answer

    def _dwell(self, dwell: Dwell) -> Point:
        if dwell.mount != self._seated:
            raise ProcedureError(f"a dwell was asked for in {dwell.mount} while the unit sits in {self._seated}")
        angle_deg = self._motion.travel(dwell.angle_deg, self._checkpoint).angle_deg
        settled = settle(self._stand.daq, self._clock, self._acquisition, self._checkpoint)
        began_s = self._elapsed_s()
        block = acquire(self._stand.daq, self._acquisition.samples, self._acquisition.rate_hz)
        self._announcer.announce(SamplesAcquired(point=len(self._points), time_s=began_s, block=block))
        point = self._point(dwell, angle_deg, began_s, block, settled)
        self._announcer.announce(PointCompleted(point=point))
        self._points.append(point)
        return point

    def _point(self, dwell: Dwell, angle_deg: float, began_s: float, block: SampleBlock, settled: bool) -> Point:
        reduction = reduce_block(block)
        if reduction.unusable:
            bad = f"{reduction.unusable} of {reduction.samples} samples are overloads or no numbers"
            self._warn(dwell, f"{bad}; the point will be set aside")
        if not settled:
            waited = f"{self._acquisition.settle_timeout_s:g} s"
            self._warn(dwell, f"the output had not settled after {waited}; the point is kept and marked")
        return Point(
            index=len(self._points),
            angle_deg=angle_deg,
            voltage_v=reduction.voltage_v,
            voltage_sd_v=reduction.voltage_sd_v,
            samples=reduction.samples,
            time_s=began_s + reduction.samples / block.rate_hz / 2,
            direction=self._motion.direction,
            temperature_degc=block.temperature_degc,
            realisation=dwell.realisation,
            procedure=dwell.procedure,
            mount=dwell.mount,
            settled=settled,
        )

    def _checkpoint(self) -> bool:
        """Stop or pause here where that is wanted; true where the run was paused, and the head braked for it."""
        self.control.check()
        if not self.control.pause_wanted():
            return False
        self._motion.brake()
        self._change(State.PAUSED)
        while self.control.pause_wanted():
            self.control.check()
            self._clock.sleep(POLL_S)
        self._change(State.RUNNING)
        return True

    def _finish(self, error: BaseException | None) -> Outcome:
        """Bring the head to a standstill, then tell everybody, the sink too, even where it was the sink that failed."""
        with suppress(Exception):  # first of all; `standstill` sees whether it helped, and says it again
            self._motion.brake()
        self._change_anyway(State.STOPPING, message_of(error))
        at_standstill = self._motion.standstill()
        if at_standstill:
            self._change_anyway(State.STANDSTILL, message_of(error))
        outcome = outcome_of(error, self._points, at_standstill)
        try:
            self._announcer.store(outcome.finished)
        except StorageError as failure:
            outcome = outcome_of(error or failure, self._points, at_standstill)
        self._announcer.tell(outcome.finished)
        return outcome

    def _change(self, state: State) -> None:
        self.state = state
        self._announcer.announce(StateChanged(state=state))

    def _change_anyway(self, state: State, reason: str) -> None:
        self.state = state
        self._announcer.announce_anyway(StateChanged(state=state, reason=reason))

    def _warn(self, dwell: Dwell, message: str) -> None:
        where = f"point {len(self._points)} ({dwell.mount} at {dwell.angle_deg:g} deg)"
        self._announcer.announce(WarningRaised(message=f"{where}: {message}"))

    def _elapsed_s(self) -> float:
        return self._clock.monotonic_s() - self._began_s
