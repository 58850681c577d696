"""Carrying out a procedure at a stand.

The engine takes steps from a procedure, has instruments and operator do what they ask for, and sends back what came of
it. It knows no procedure, no instrument and no recording; in whatever way a run ends, everything is brought to rest.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from functools import partial

from tumble.calibrations.core.sentences import series
from tumble.drivers.protocols import Identity, Stand
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.announcer import Announcer, Listener, Sink
from tumble.procedures.axes import Axes, Look, look_away
from tumble.procedures.composition import advance
from tumble.procedures.control import Control
from tumble.procedures.ending import Ending
from tumble.procedures.environments import Environments
from tumble.procedures.errors import RetakeRequestedError
from tumble.procedures.events import (
    RetakeBegun,
    RunResumed,
    State,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.exciters import Exciters
from tumble.procedures.interlock import Interlock
from tumble.procedures.journeys import POLL_S
from tumble.procedures.losses import Losses
from tumble.procedures.measuring import Measuring
from tumble.procedures.operator import Operator
from tumble.procedures.outcome import Outcome
from tumble.procedures.phase import Phase
from tumble.procedures.recovery import Recovery
from tumble.procedures.replay import replay
from tumble.procedures.requests import Requests
from tumble.procedures.sampling import Sampling
from tumble.procedures.second_look import SecondLook
from tumble.procedures.steps import Ask, Beginning, Dwell, Point, Procedure, Reply, Step
from tumble.procedures.taking import Taking
from tumble.procedures.verification import check_agreement, verified


class Engine:
    """Carries out one run.

    A pause or a stop that its `control` is asked for, from any thread, is heeded between steps, while a positioner
    moves and while the outputs settle; a stop also while the operator, a lost link or the answer of a sampler is
    awaited. Samples being taken are taken first, where a stop need not wait for them. A step in which a link is lost
    begins anew once it is back, see `Recovery`.

    The last point is taken again where that is asked for, as long as the run is not over: at once, but not while
    samples are taken, a link is lost or the run is paused. The step under way is given up; a condition that is another
    one by now is asked for as it was; the positioners come back as they came then. The later reading takes the place
    of the one before, also in what the procedure is told, which goes on from there.

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
        self._announcer = Announcer(sink, listeners)
        self._phase = Phase(self._announcer)
        self._acquisition = acquisition
        self.control = control or Control()
        """Pauses, resumes and stops the run; from any thread."""
        losses = Losses(stand.title)
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
        environments = Environments(stand, acquisition, sampling, self._recovery, losses, self._interlock, self._heed)
        self._requests = Requests(
            operator,
            stand.clock,
            environments,
            self._exciters,
            self._recovery,
            self._announcer.announce,
            self._phase.change,
            self._heed,
        )
        self._ending = Ending(
            axes=self._axes,
            exciters=self._exciters,
            interlock=self._interlock,
            recovery=self._recovery,
            announcer=self._announcer,
            phase=self._phase,
            moving=series([stand.title(name) for name in (*stand.positioners, *stand.exciters)], "or"),
        )
        self._taking = Taking(
            self._measuring,
            eyepiece,
            self._announcer.announce,
            self.control.check,
            self._heed,
            acquisition.settle_timeout_s,
        )
        self._by_eye = eyepiece is not None
        self._under_way = False

    @property
    def state(self) -> State:
        """Where the run stands; only the engine changes it."""
        return self._phase.state

    def run(self, begin: Beginning) -> Outcome:
        """Carry out a procedure to its end, or until something else ends it, and bring everything to a standstill."""
        self._taking.began_s = self._clock.monotonic_s()
        self.control.heed_again()  # a wish from before it began is of another run
        procedure = begin()
        return self._to_its_end(begin, procedure, next(procedure, None), self._meet)

    def resume(
        self,
        begin: Beginning,
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
            Where `journal` is not the beginning of the procedure; nothing has moved then.
        """
        procedure = begin()
        replayed = replay(procedure, journal, self._replay_tolerance_deg)
        self._taking.points = list(replayed.points)
        self._recovery.know(known or {})
        return self._to_its_end(
            begin, procedure, replayed.pending, partial(self._go_on, replayed.asks, elapsed_s, tolerance_v)
        )

    @property
    def _points(self) -> list[Point]:
        return self._taking.points

    @property
    def _replay_tolerance_deg(self) -> float:
        """What a person reads may differ by anything from what was to be set."""
        return math.inf if self._by_eye else self._acquisition.position_tolerance_deg

    def _to_its_end(
        self, begin: Beginning, procedure: Procedure, step: Step | None, prepare: Callable[[], None]
    ) -> Outcome:
        try:
            with self._attention.paid_to(self.control.check):  # and no longer: at the end nothing breaks a wait off
                self._carry_out(begin, procedure, step, prepare)
        except (Exception, KeyboardInterrupt) as error:
            return self._ending.of(error, self._points)
        except BaseException as error:
            self._ending.of(error, self._points)
            raise
        return self._ending.of(None, self._points)

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
        self._taking.began_s = self._clock.monotonic_s() - max(elapsed_s(), last.time_s if last else 0.0)

    def _carry_out(
        self, begin: Beginning, procedure: Procedure, step: Step | None, prepare: Callable[[], None]
    ) -> None:
        self._phase.change(State.RUNNING)
        if step is None:
            return None
        self._recovery.persist(self._checkpoint)
        prepare()
        self._recovery.persist(self._interlock.begin)
        self._recovery.reference()
        self._under_way, again = True, False
        while True:
            try:
                if again:
                    self._take_again(begin)
                    procedure = begin()
                    step = replay(procedure, self._points, self._replay_tolerance_deg).pending
                return self._follow(procedure, step)
            except RetakeRequestedError:
                again = True

    def _follow(self, procedure: Procedure, step: Step | None) -> None:
        """Carry out a step and all that come after it."""
        while step is not None:
            self._recovery.persist(self._checkpoint, self._axes.places)
            self._announcer.announce(StepStarted(step=step))
            reply = self._requests.fulfil(step) if isinstance(step, Ask) else self._taken(step)
            self._recovery.tell_remarks()
            self._heed()
            step = advance(procedure, reply)
        self._measuring.unwind()

    def _taken(self, dwell: Dwell) -> Point:
        self._requests.check(dwell)
        return self._taking.take(dwell)

    def _take_again(self, begin: Beginning) -> None:
        """Bring all to rest, and measure the last point once more, under the conditions that it was taken under."""
        self._recovery.persist(self._axes.halt)
        replayed = replay(begin(), self._points, self._replay_tolerance_deg)
        self._announcer.announce(RetakeBegun(point=len(self._points) - 1))
        self._phase.change(State.RUNNING)
        for ask in replayed.asks:
            if not self._requests.stands(ask):
                self._requests.fulfil(ask)
        dwell = replayed.dwells[-1]
        self._announcer.announce(StepStarted(step=dwell))
        self._taking.take_again(dwell)

    def _verify(self, last: Point, asks: Iterable[Ask], tolerance_v: float | None) -> None:
        """Bring everything back to where `last` was taken, and see whether a point gives there what it gave."""
        for name, angle_deg in last.positions_deg.items():
            self._recovery.persist(partial(self._recovery.tell_of_winding, name, angle_deg))
        for ask in asks:
            self._requests.fulfil(ask)
        self._measuring.home()
        now = self._measuring.measure_again(last).readings
        for seen in verified(self._points, now, self._acquisition.position_tolerance_deg, tolerance_v):
            self._announcer.announce(seen)
            check_agreement(seen)

    def _guarded(self) -> bool:
        """The same, while something turns: only behind doors that are shut."""
        self._interlock.check()
        return self._checkpoint()

    def _heed(self) -> None:
        """Stop here where that is wanted, or give the step up to take the last point again."""
        self.control.check()
        if not self._under_way or (wanted := self.control.heed_again()) is None:
            return
        last = len(self._points) - 1
        if wanted == last:
            raise RetakeRequestedError
        late = Message("point {point} is not taken again: it is not the last one any more", point=wanted)
        self._announcer.announce(WarningRaised(message=late))

    def _checkpoint(self) -> bool:
        """Stop or pause here where that is wanted; true where the run was paused, and everything stood for it."""
        self.control.check()
        if not self.control.pause_wanted():
            self._heed()
            return False
        self._axes.halt()
        self._exciters.clear()
        self._phase.change(State.PAUSED)
        while self.control.pause_wanted():
            self.control.check()
            self._clock.sleep(POLL_S)
        self._phase.change(State.RUNNING)
        self._heed()
        return True
