"""The one way to the instruments: one thread talks to them, and nobody else does."""

import atexit
from collections.abc import Callable
from functools import partial
from queue import Empty, SimpleQueue

from PySide6.QtCore import QObject, Signal, SignalInstance, Slot

from tumble.app.exits import Exit, JobError
from tumble.app.patience import PatientControl
from tumble.app.stand import LoadedStand
from tumble.app.wiring import Attendant
from tumble.procedures.control import Control
from tumble.procedures.errors import InputError, StopRequestedError
from tumble.window.look.language import tr
from tumble.window.work.activity import Activity
from tumble.window.work.bridge import EventBridge
from tumble.window.work.order_thread import OrderThread
from tumble.window.work.session import StandSession
from tumble.window.work.stand_orders import Move, StandOrders
from tumble.window.work.stand_signals import StandSignals

Action = Callable[[Control], object]


class StandWorker(StandSignals):
    """Has a thread carry out one order after the other; is called, and emits its signals, in the event loop.

    An order belongs to the stand that was chosen when it was given. While anything is under way no other stand is
    chosen, and no run or move is taken on: nothing that moves waits for its turn. `stop` is heeded by whatever is under
    way, and brakes a head that moves without an order.
    """

    _posted = Signal(object)

    def __init__(self, bridge: EventBridge, loaded: LoadedStand, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bridge, self._orders = bridge, StandOrders(bridge, self, self._tell)
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
        self._begin(partial(self._orders.connect, session, attendant))

    def disconnect_from(self) -> None:
        """Leave the instruments."""
        self._thread.put(partial(self._orders.leave, self.session), self._tell_of)

    def begin(self, activity: Activity, attendant: Attendant) -> bool:
        """Carry out a run unless something is under way; returns whether it was taken on.

        Raises `InputError` where the run belongs to another stand than the one that is chosen.
        """
        self.session.check_is_of(activity.job.stand)
        action = partial(self._orders.measure, self.session, activity, attendant)
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
        self._order(lambda _: self._orders.halt(session))

    def retire(self) -> None:
        """Stop, read the standstill back and leave the stand; `rested` or `stuck` says what came of it."""
        session = self._stopped()
        self._order(lambda _: self._orders.retire(session), self.stuck)

    def settle(self, within_s: float) -> bool:
        """As `retire`, and wait for it; returns whether the standstill was read back in time."""
        session, told = self._stopped(), SimpleQueue[bool]()

        def action(_: Control) -> None:
            try:
                self._orders.retire(session)
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
        self._begin(partial(self._orders.move, self.session, name, move))

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

    def _look(self) -> None:
        self._orders.look(self.session, self._watched, self._give_way)

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
