"""The one way to the instruments: one thread talks to them, and nobody else does."""

import atexit
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from queue import Empty, SimpleQueue

from PySide6.QtCore import QObject, Signal, SignalInstance, Slot

from tumble.app.exits import Exit, JobError
from tumble.app.patience import PatientControl
from tumble.app.simulation import Past
from tumble.app.stand import LoadedStand
from tumble.app.wiring import Attendant, Connected
from tumble.drivers.errors import naming
from tumble.procedures.control import Control
from tumble.procedures.errors import InputError, StopRequestedError
from tumble.procedures.interlock import Interlock
from tumble.procedures.motion import Motion
from tumble.window.look.language import tr
from tumble.window.work.activity import Activity, progress_of
from tumble.window.work.bridge import EventBridge
from tumble.window.work.order_thread import OrderThread
from tumble.window.work.session import StandSession

Action = Callable[[Control], object]
Move = Callable[[Motion, Callable[[], bool]], object]


class StandWorker(QObject):
    """Has a thread carry out one order after the other; is called, and emits its signals, in the event loop.

    An order belongs to the stand that was chosen when it was given. While anything is under way no other stand is
    chosen, and no run or move is taken on: nothing that moves waits for its turn. `stop` is heeded by whatever is under
    way, and brakes a head that moves without an order.
    """

    chosen = Signal(object)
    """`LoadedStand`, in place of the one before."""
    connected = Signal(object)
    """`StandIdentity`."""
    disconnected = Signal()
    position_seen = Signal(str, object)
    """Name and `PositionerStatus` of a positioner that nobody moves."""
    reading_seen = Signal(str, object)
    """Name and samples of a sampler or an environment, or None where it has none, while somebody watches."""
    working = Signal(bool)
    """Whether an order is under way; leaving a stand is none."""
    stage = Signal(str)
    """What an activity does before its run."""
    recorded = Signal(object)
    """Path of the recording of a run that is over, however it ended."""
    measured = Signal(object)
    """`Conclusion`: an activity needs the stand no longer."""
    broken_off = Signal(object)
    """The exception that ended an activity."""
    stopping = Signal()
    """Everything is told to stop."""
    failed = Signal(object)
    """The exception that ended any other order."""
    restless = Signal()
    """The standstill of the head could not be read back."""
    rested = Signal()
    """The stand was left with its head at rest, as `retire` demanded."""
    stuck = Signal(object)
    """The exception for which it was not."""
    _posted = Signal(object)

    def __init__(self, bridge: EventBridge, loaded: LoadedStand, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bridge = bridge
        self._controls: list[Control] = []
        self._watched = False
        self.session = StandSession(loaded, bridge.look)
        """The stand that is on screen, and the only one whose instruments are ever connected."""
        self._posted.connect(self._carry)
        self._thread = OrderThread(self._posted.emit, idle=(self._look, self._tell_of))
        atexit.register(self.leave)  # however the program ends, the head is brought to rest

    @property
    def busy(self) -> bool:
        """Whether an order is under way, or anything that it told is still to be delivered."""
        return bool(self._controls)

    def use(self, loaded: LoadedStand) -> None:
        """Choose another stand; the one before is left. Raises `InputError` while that one is at work."""
        if self.busy:
            raise InputError(tr("The stand is at work: stop it, or wait, before you choose another"))
        self.disconnect_from()
        self.session = StandSession(loaded, self._bridge.look)
        self.chosen.emit(loaded)

    def connect_to(self, attendant: Attendant) -> None:
        """Reach the instruments of the stand that is chosen."""
        session = self.session
        self._begin(lambda control: self._connect(session, attendant, control))

    def disconnect_from(self) -> None:
        """Leave the instruments."""
        self._thread.put(partial(self._leave_stand, self.session), self._tell_of)

    def begin(self, activity: Activity, attendant: Attendant) -> bool:
        """Carry out a run unless something is under way; returns whether it was taken on.

        Raises `InputError` where the run belongs to another stand than the one that is chosen.
        """
        self.session.check_is_of(activity.job.stand)
        action = partial(self._carry_out, self.session, activity, attendant)
        return self._take_on(partial(_run_unless_stopped, action), self.broken_off)

    def watch(self, watched: bool) -> None:
        """Whether somebody looks at what the samplers read while there is nothing else to do."""
        self._watched = watched

    def move_to(self, name: str, angle_deg: float) -> None:
        """Turn a positioner to an angle."""
        self._move(name, lambda motion, checkpoint: motion.travel(angle_deg, checkpoint))

    def move_by(self, name: str, step_deg: float) -> None:
        """Turn a positioner by an angle from where it stands."""
        session = self.session
        self._move(
            name,
            lambda motion, checkpoint: motion.travel(session.statuses[name].angle_deg + step_deg, checkpoint),
        )

    def home(self, name: str) -> None:
        """Have a positioner find its reference."""
        self._move(name, lambda motion, checkpoint: motion.home(checkpoint))

    def pause(self) -> None:
        """Pause the run."""
        for control in self._controls:
            control.pause()

    def resume(self) -> None:
        """Go on with a run that is paused."""
        for control in self._controls:
            control.resume()

    def take_again(self, point: int) -> None:
        """Have the last point of the run measured once more; `point` is its number, from 0."""
        for control in self._controls:
            control.take_again(point)

    def stop(self) -> None:
        """Bring the head to rest, whatever is under way."""
        session = self._stopped()
        self._order(lambda _: self._halt(session))

    def retire(self) -> None:
        """Stop, read the standstill back and leave the stand; `rested` or `stuck` says what came of it."""
        session = self._stopped()
        self._order(lambda _: self._retire(session), self.stuck)

    def settle(self, within_s: float) -> bool:
        """As `retire`, and wait for it; returns whether the standstill was read back in time."""
        session, told = self._stopped(), SimpleQueue[bool]()

        def action(_: Control) -> None:
            try:
                self._retire(session)
                told.put(True)
            finally:
                told.put(False)

        self._order(action, self.stuck)
        try:
            return told.get(timeout=within_s)
        except Empty:
            return False

    def leave(self) -> None:
        """Stop, leave the stand, and end the thread; returns when that is done."""
        atexit.unregister(self.leave)
        self.stop()
        self.disconnect_from()
        self._thread.end()

    def _stopped(self) -> StandSession:
        self.stopping.emit()
        for control in self._controls:
            control.stop()
        return self.session

    def _begin(self, action: Action) -> bool:
        return self._take_on(partial(_unless_stopped, action))

    def _take_on(self, action: Action, failed: SignalInstance | None = None) -> bool:
        if self.busy:
            return False
        self._order(action, failed)
        return True

    def _order(self, action: Action, failed: SignalInstance | None = None) -> None:
        control = PatientControl()
        self._controls.append(control)
        self._thread.put(partial(action, control), partial(self._end, control, failed or self.failed))
        self.working.emit(True)

    def _move(self, name: str, move: Move) -> None:
        self._begin(partial(self._carry_out_move, self.session, name, move))

    def _end(self, control: Control, failed: SignalInstance, error: BaseException | None) -> None:
        self._controls.remove(control)
        if not isinstance(error, StopRequestedError):  # that is as was asked
            self._tell_of(error, failed)
        self.working.emit(self.busy)

    def _tell_of(self, error: BaseException | None, failed: SignalInstance | None = None) -> None:
        if error is not None:
            (failed or self.failed).emit(error)

    @Slot(object)
    def _carry(self, posted: Callable[[], None]) -> None:
        posted()

    def _tell(self, session: StandSession, signal: SignalInstance, *told: object) -> None:
        """Emit a signal in the event loop, where what it tells of is the stand on screen; from the stand's thread."""
        self._posted.emit(lambda: signal.emit(*told) if session is self.session else None)

    # What follows happens in the thread of the stand.

    def _connect(
        self, session: StandSession, attendant: Attendant, control: Control, past: Sequence[Past] = ()
    ) -> Connected:
        self._leave_stand(session)
        self._tell(session, self.connected, session.connect(attendant, past, control.check))
        return session.connected

    def _leave_stand(self, session: StandSession) -> None:
        if session.is_connected:
            self._tell(session, self.disconnected)
            session.disconnect()

    def _carry_out(self, session: StandSession, activity: Activity, attendant: Attendant, control: Control) -> None:
        """Run at the instruments that are connected, unless a simulated stand must live through something first."""
        as_it_is = session.is_connected and not activity.past
        connected = session.connected if as_it_is else self._connect(session, attendant, control, activity.past)
        self._bridge.count(progress_of(activity, connected))
        ready = replace(connected, control=control, look=self._bridge.look)
        tell, ran = partial(self._tell, session, self.stage), len(connected.ran)
        try:
            conclusion = activity.measure(ready, [self._bridge.listen], tell)
        except BaseException:
            self._leave_what_is_lost(session)
            raise
        finally:
            for path in connected.ran[ran:]:
                self._tell(session, self.recorded, path)
        self._tell(session, self.measured, conclusion)

    def _leave_what_is_lost(self, session: StandSession) -> None:
        """Leave a stand that answers no longer: why the run broke off is told once, and not again by the next look."""
        if not session.answers:
            with suppress(Exception):
                self._leave_stand(session)

    def _carry_out_move(self, session: StandSession, name: str, move: Move, control: Control) -> None:
        motion, interlock = session.motion(name), session.interlock()
        try:
            with session.heeding(control.check), naming(name, motion.title):
                interlock.check()
                move(motion, lambda: _checked(control, interlock))
        finally:
            self._halt(session)

    def _halt(self, session: StandSession) -> None:
        try:
            session.halt()
        except BaseException:
            self._tell(session, self.restless)
            raise

    def _retire(self, session: StandSession) -> None:
        self._halt(session)
        self._leave_stand(session)
        self._tell(session, self.rested)

    def _look(self) -> None:
        session = self.session
        if not session.is_connected:
            return
        try:
            with session.heeding(self._give_way):
                self._look_at(session)
        except StopRequestedError:  # the next look sees what this one has not
            return
        except Exception:
            self._leave_stand(session)
            raise

    def _look_at(self, session: StandSession) -> None:
        for name, climate in session.climates.items() if self._watched else ():
            self._tell(session, self.reading_seen, name, climate)
        for name, status in session.statuses.items():
            self._tell(session, self.position_seen, name, status)
        for name, block in session.readings(self._give_way).items() if self._watched else ():
            self._tell(session, self.reading_seen, name, block)

    def _give_way(self) -> None:
        """Look no longer where an order waits."""
        if self._thread.is_wanted:
            raise StopRequestedError


def _unless_stopped(action: Action, control: Control) -> None:
    control.check()
    action(control)


def _run_unless_stopped(action: Action, control: Control) -> None:
    """As `_unless_stopped`; whoever waits for the end of a run is told of a stop before its first event too."""
    try:
        _unless_stopped(action, control)
    except StopRequestedError as error:
        raise JobError(str(error), Exit.STOPPED) from error


def _checked(control: Control, interlock: Interlock) -> bool:
    """Stop where that is wanted, or a door is opened; a move by hand is never paused."""
    control.check()
    interlock.check()
    return False
