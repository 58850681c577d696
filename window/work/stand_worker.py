"""The one thread that talks to the instruments: nobody else does, so that nobody is ever in another's way."""

import atexit
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Final

from PySide6.QtCore import QObject, Signal

from app.simulation import Past
from app.stand import LoadedStand
from app.stand_lock import holding
from app.wiring import Attendant, Connected, connect
from drivers.errors import DeviceError
from drivers.protocols import HeadStatus, Identity
from procedures.control import Control
from procedures.errors import StopRequestedError
from procedures.motion import Motion
from window.work.activity import Activity, progress_of
from window.work.bridge import EventBridge
from window.work.patience import PatientControl

_LOOK_S: Final = 0.2
"""Between two looks at a head that nobody moves."""
_TOLERANCE_DEG: Final = 0.01

Order = Callable[[Control], object]
Move = Callable[[Motion, Callable[[], bool]], object]


@dataclass(frozen=True, kw_only=True)
class StandIdentity:
    """A stand that answers."""

    loaded: LoadedStand
    head: Identity
    daq: Identity
    status: HeadStatus
    warnings: tuple[str, ...]


class StandWorker(QObject):
    """Carries out one order after the other in its own thread; its signals arrive in the event loop.

    `stop` is heeded by whatever is under way or waits, and brakes a head that moves without an order.
    """

    connected = Signal(object)
    """`StandIdentity`."""
    disconnected = Signal()
    head_seen = Signal(object)
    """`HeadStatus` of a head that nobody moves."""
    working = Signal(bool)
    """Whether an order is under way."""
    stage = Signal(str)
    """What an activity does once its run is over."""
    concluded = Signal(object)
    """`Concluded`."""
    failed = Signal(object)
    """The exception that ended an order."""

    def __init__(self, bridge: EventBridge, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bridge = bridge
        self._orders: SimpleQueue[tuple[Order, Control] | None] = SimpleQueue()
        self._controls: deque[Control] = deque()
        self._stand: Connected | None = None
        self._loaded: LoadedStand | None = None
        self._held = ExitStack()
        self._thread = Thread(target=self._work, name="stand", daemon=True)
        self._thread.start()
        atexit.register(self.leave)  # however the program ends, the head is brought to rest

    def connect_to(self, loaded: LoadedStand, attendant: Attendant) -> None:
        """Reach the instruments of a stand, after leaving those of another."""
        self._order(lambda _: self._connect(loaded, attendant))

    def disconnect_from(self) -> None:
        """Leave the stand."""
        self._order(lambda _: self._disconnect())

    def begin(self, activity: Activity, attendant: Attendant) -> None:
        """Carry out a run; where its stand is not the one that is connected, that is connected first."""
        self._order(partial(self._carry_out, activity, attendant))

    def move_to(self, angle_deg: float) -> None:
        """Turn the head to an angle."""
        self._order(partial(self._move, lambda motion, checkpoint: motion.travel(angle_deg, checkpoint)))

    def move_by(self, step_deg: float) -> None:
        """Turn the head by an angle from where it stands."""
        self._order(lambda control: self._move_by(step_deg, control))

    def home(self) -> None:
        """Have the head find its reference."""
        self._order(partial(self._move, lambda motion, checkpoint: motion.home(checkpoint)))

    def pause(self) -> None:
        """Pause the run."""
        for control in tuple(self._controls):
            control.pause()

    def resume(self) -> None:
        """Go on with a run that is paused."""
        for control in tuple(self._controls):
            control.resume()

    def stop(self) -> None:
        """Bring the head to rest, whatever is under way; what waits is not begun."""
        for control in tuple(self._controls):
            control.stop()
        self._order(lambda _: self._brake())

    def leave(self) -> None:
        """Stop, leave the stand, and end the thread; returns when that is done."""
        atexit.unregister(self.leave)
        self.stop()
        self.disconnect_from()
        self._orders.put(None)
        self._thread.join()

    def _order(self, order: Order) -> None:
        control = PatientControl()
        self._controls.append(control)
        self._orders.put((order, control))

    def _work(self) -> None:
        while True:
            try:
                wanted = self._orders.get(timeout=_LOOK_S)
            except Empty:
                self._guarded(self._look)
                continue
            if wanted is None:
                return
            order, control = wanted
            self.working.emit(True)
            self._guarded(lambda order=order, control=control: self._do(order, control))  # type: ignore[misc]
            self._controls.remove(control)
            self.working.emit(bool(self._controls))

    def _guarded(self, action: Callable[[], None]) -> None:
        try:
            action()
        except StopRequestedError:
            pass  # as was asked
        except Exception as error:  # whatever it is, the event loop shows it
            self.failed.emit(error)

    def _do(self, order: Order, control: Control) -> None:
        control.check()
        order(control)

    def _connect(self, loaded: LoadedStand, attendant: Attendant, past: Sequence[Past] = ()) -> Connected:
        self._disconnect()
        with ExitStack() as stack:
            stack.enter_context(holding(loaded, "no unit yet"))
            stand = connect(loaded, attendant=attendant, past=past)
            stack.callback(stand.links.close)
            identity = StandIdentity(
                loaded=loaded,
                head=stand.stand.head.identify(),
                daq=stand.stand.daq.identify(),
                status=stand.stand.head.status(),
                warnings=stand.warnings,
            )
            self._stand, self._loaded, self._held = stand, loaded, stack.pop_all()
        self.connected.emit(identity)
        return stand

    def _disconnect(self) -> None:
        if self._stand is not None:
            self._stand = self._loaded = None
            self._held.close()
            self.disconnected.emit()

    def _carry_out(self, activity: Activity, attendant: Attendant, control: Control) -> None:
        stand = self._stand_of(activity, attendant)
        self._bridge.count(progress_of(activity, stand))
        ready = replace(stand, control=control, look=self._bridge.look)
        self.concluded.emit(activity.carry_out(ready, [self._bridge.listen], self.stage.emit))

    def _stand_of(self, activity: Activity, attendant: Attendant) -> Connected:
        """The stand that is connected, if the run belongs there and began there."""
        if self._stand is not None and not activity.past and self._loaded == activity.job.stand:
            return self._stand
        return self._connect(activity.job.stand, attendant, activity.past)

    def _motion(self) -> Motion:
        if self._stand is None:
            raise DeviceError("stand", "is not connected", "connect it first")
        return Motion(self._stand.stand.head, self._stand.stand.clock, _TOLERANCE_DEG, look=self._bridge.look)

    def _move(self, move: Move, control: Control) -> None:
        motion = self._motion()
        try:
            move(motion, lambda: _checked(control))
        finally:
            motion.halt()

    def _move_by(self, step_deg: float, control: Control) -> None:
        stand = self._stand
        here_deg = stand.stand.head.status().angle_deg if stand else 0.0
        self._move(lambda motion, checkpoint: motion.travel(here_deg + step_deg, checkpoint), control)

    def _brake(self) -> None:
        if self._stand is not None:
            self._motion().halt()

    def _look(self) -> None:
        if self._stand is None:
            return
        try:
            self.head_seen.emit(self._stand.stand.head.status())
        except Exception:
            self._disconnect()
            raise


def _checked(control: Control) -> bool:
    """Stop where that is wanted; a move by hand is never paused."""
    control.check()
    return False
