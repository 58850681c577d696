"""The course of a run: from the stand, where it is measured, to its result, which comes of it beside."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from tumble.app.exits import Exit, JobError
from tumble.app.wiring import Attendant
from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.events import Event, PointCompleted, RetakeBegun, RunFinished, State, StateChanged
from tumble.window.screens.run_state import RunState
from tumble.window.work.activity import Activity, Concluded, Conclusion
from tumble.window.work.bridge import EventBridge
from tumble.window.work.conclusions import Conclusions
from tumble.window.work.stand_worker import StandWorker


class RunCourse(QObject):
    """Begins runs, knows where they stand, and has them concluded; every signal but `heard` names its `Activity`."""

    changed = Signal()
    """What is known in `now`."""
    heard = Signal(object)
    """`Event` of the run that has the stand."""
    recorded = Signal(object, object)
    """And the path of the recording."""
    measured = Signal(object)
    """The stand is free; the analysis begins."""
    broke_off = Signal(object, object)
    """And the exception that ended it at the stand."""
    stage = Signal(str)
    """What the analysis that is under way does."""
    concluded = Signal(object, object)
    """And `Concluded`."""
    failed = Signal(object, object)
    """And the exception that ended its analysis."""

    def __init__(
        self,
        worker: StandWorker,
        bridge: EventBridge,
        attendant: Callable[[], Attendant],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._worker, self._attendant = worker, attendant
        self.now = RunState()
        self._activity: Activity | None = None
        self._conclusions = Conclusions(self)
        bridge.announced.connect(self._hear)
        worker.position_seen.connect(self._see)
        worker.connected.connect(lambda _: self.see_rest())
        worker.restless.connect(self.see_unrest)
        worker.stopping.connect(self._see_stop)
        worker.working.connect(self._see_work)
        worker.recorded.connect(self._record)
        worker.measured.connect(self._end_well)
        worker.broken_off.connect(self._end_badly)
        self._conclusions.stage.connect(self.stage)
        self._conclusions.concluded.connect(self._conclude)
        self._conclusions.failed.connect(self._fail)

    @property
    def is_free(self) -> bool:
        """Whether the stand is."""
        return not self.now.running and not self._worker.busy

    @property
    def positioners(self) -> tuple[str, ...]:
        """Of the stand, by name."""
        return tuple(self._worker.session.loaded.file.positioners)

    def begin(self, activity: Activity) -> bool:
        """Begin a run unless the stand is at work; returns whether it was begun. Raises `InputError`."""
        if self.now.running or not self._worker.begin(activity, self._attendant()):
            return False
        self._activity = activity
        self.now.begin(activity.points_done)
        return True

    def pause(self) -> None:
        """Pause the run."""
        self.now.pausing = True
        self._worker.pause()
        self.changed.emit()

    def go_on(self) -> None:
        """Go on with a run that is paused."""
        self.now.pausing = False
        self._worker.resume()
        self.changed.emit()

    def repeat(self) -> None:
        """Have the last point taken again."""
        self.now.repeating = True
        self._worker.take_again(self.now.last)
        self.changed.emit()

    def await_reading(self, awaited: bool) -> None:
        """Whether a reading of the head is awaited."""
        self.now.reading = awaited
        self.changed.emit()

    def await_unit(self, awaited: bool) -> None:
        """Whether the next unit is awaited."""
        self.now.changing_unit = awaited
        self.changed.emit()

    def await_choice(self, awaited: bool) -> None:
        """Whether somebody is to say what becomes of a run that was stopped."""
        self.now.stopped = awaited
        self.changed.emit()

    def see_rest(self) -> None:
        """The standstill of the stand was read back."""
        self.now.settle(at_standstill=True)
        self.changed.emit()

    def see_unrest(self) -> None:
        """It could not be read back."""
        self.now.settle(at_standstill=False)
        self.changed.emit()

    def leave(self) -> None:
        """Begin nothing more, and wait for what is written."""
        self._conclusions.leave()

    @property
    def _run(self) -> Activity:
        """That which has the stand, or had it last."""
        assert self._activity is not None, "nothing is told of a run before one was begun"
        return self._activity

    def _hear(self, event: Event) -> None:
        if not self.now.running:
            return
        repeatable = self.now.repeatable
        if isinstance(event, StateChanged):
            self.now.change(event.state)
        elif isinstance(event, PointCompleted):
            self.now.complete(event.point.index)
        elif isinstance(event, RunFinished):
            self.now.reading = False
            self.now.settle(event.at_standstill)
        self.heard.emit(event)
        if isinstance(event, StateChanged) or repeatable != self.now.repeatable:
            self.changed.emit()

    def _see_stop(self) -> None:
        self.now.halting = True

    def _see_work(self, working: bool) -> None:
        self.now.at_work, self.now.halting = working, working and self.now.halting
        self.changed.emit()

    def _see(self, name: str, status: PositionerStatus) -> None:
        before = self.now.restless
        self.now.see(name, status.moving, self.positioners)
        if before != self.now.restless:
            self.changed.emit()

    def _record(self, path: Path) -> None:
        self.recorded.emit(self._run, path)

    def _end_well(self, conclusion: Conclusion) -> None:
        self.now.end()
        self._conclusions.add(self._run, conclusion)
        self._count()
        self.measured.emit(self._run)
        self.changed.emit()

    def _end_badly(self, error: BaseException) -> None:
        self.now.end()
        self.now.stopped, self.now.faulty = True, not was_stopped(error)
        self.broke_off.emit(self._run, error)
        self.changed.emit()

    def _conclude(self, activity: Activity, concluded: Concluded) -> None:
        self._count()
        self.changed.emit()
        self.concluded.emit(activity, concluded)

    def _fail(self, activity: Activity, error: BaseException) -> None:
        self._count()
        self.failed.emit(activity, error)
        self.changed.emit()

    def _count(self) -> None:
        self.now.concluding = len(self._conclusions.waiting)


def was_stopped(error: BaseException) -> bool:
    """Whether a run ended because somebody stopped it."""
    return isinstance(error, JobError) and error.status is Exit.STOPPED


def asks_nothing(event: Event) -> bool:
    """Whether whatever was asked for need not be answered any more."""
    if isinstance(event, StateChanged):
        return event.state not in (State.AWAITING_OPERATOR, State.RUNNING)
    return isinstance(event, RunFinished | RetakeBegun)
