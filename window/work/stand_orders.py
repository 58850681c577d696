"""What is done with the instruments of a stand, in the thread that alone talks to them."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from tumble.app.simulation import Past
from tumble.app.wiring import Attendant, Connected
from tumble.drivers.errors import naming
from tumble.procedures.control import Control
from tumble.procedures.errors import StopRequestedError
from tumble.procedures.interlock import Interlock
from tumble.procedures.motion import Motion
from tumble.window.work.activity import Activity, progress_of
from tumble.window.work.bridge import EventBridge
from tumble.window.work.session import StandSession
from tumble.window.work.stand_signals import StandSignals

Move = Callable[[Motion, Callable[[], bool]], object]


class StandOrders:
    """Carries orders out, each at the session for which it was given; what goes wrong is raised.

    Parameters
    ----------
    bridge
        Hears what a run tells.
    signals
        What there is to tell.
    tell
        Emits one of these, with what it tells, in the event loop, where a session is still the one on screen.
    """

    def __init__(self, bridge: EventBridge, signals: StandSignals, tell: Callable[..., None]) -> None:
        self._bridge, self._signals, self._tell = bridge, signals, tell

    def connect(
        self, session: StandSession, attendant: Attendant, control: Control, past: Sequence[Past] = ()
    ) -> Connected:
        """Reach the instruments, which are left before. Raises as `StandSession.connect`."""
        self.leave(session)
        self._tell(session, self._signals.connected, session.connect(attendant, past, control.check))
        return session.connected

    def leave(self, session: StandSession) -> None:
        """Leave the instruments, where they are connected. Raises what closing them raises."""
        if session.is_connected:
            self._tell(session, self._signals.disconnected)
            session.disconnect()

    def measure(self, session: StandSession, activity: Activity, attendant: Attendant, control: Control) -> None:
        """Run at the instruments that are connected, unless a simulated stand must live through something first.

        Raises as `connect`, and what ends the activity.
        """
        as_it_is = session.is_connected and not activity.past
        connected = session.connected if as_it_is else self.connect(session, attendant, control, activity.past)
        self._bridge.count(progress_of(activity, connected))
        ready = replace(connected, control=control, look=self._bridge.look)
        tell, ran = partial(self._tell, session, self._signals.stage), len(connected.ran)
        try:
            conclusion = activity.measure(ready, [self._bridge.listen], tell)
        except BaseException:
            self._leave_what_is_lost(session)
            raise
        finally:
            for path in connected.ran[ran:]:
                self._tell(session, self._signals.recorded, path)
        self._tell(session, self._signals.measured, conclusion)

    def move(self, session: StandSession, name: str, move: Move, control: Control) -> None:
        """Move a positioner, and bring it to rest whatever happens. Raises `DeviceError`, `StopRequestedError`."""
        motion, interlock = session.motion(name), session.interlock()
        try:
            with session.heeding(control.check), naming(name, motion.title):
                interlock.check()
                move(motion, lambda: _checked(control, interlock))
        finally:
            self.halt(session)

    def halt(self, session: StandSession) -> None:
        """Read the standstill back. Raises `DeviceError` where that could not be done, which is told."""
        try:
            session.halt()
        except BaseException:
            self._tell(session, self._signals.restless)
            raise

    def retire(self, session: StandSession) -> None:
        """Read the standstill back, leave the stand, and tell that. Raises as `halt`."""
        self.halt(session)
        self.leave(session)
        self._tell(session, self._signals.rested)

    def look(self, session: StandSession, watched: bool, give_way: Callable[[], None]) -> None:
        """Look where everything stands, and where somebody watches what is read; a stand that is lost is left.

        `give_way` is called while an answer is awaited, and ends the look by raising `StopRequestedError`.
        """
        if not session.is_connected:
            return
        try:
            with session.heeding(give_way):
                self._look_at(session, watched, give_way)
        except StopRequestedError:  # the next look sees what this one has not
            return
        except Exception:
            self.leave(session)
            raise

    def _look_at(self, session: StandSession, watched: bool, give_way: Callable[[], None]) -> None:
        for name, climate in session.climates.items() if watched else ():
            self._tell(session, self._signals.reading_seen, name, climate)
        for name, status in session.statuses.items():
            self._tell(session, self._signals.position_seen, name, status)
        for name, block in session.readings(give_way).items() if watched else ():
            self._tell(session, self._signals.reading_seen, name, block)

    def _leave_what_is_lost(self, session: StandSession) -> None:
        """Leave a stand that answers no longer: why the run broke off is told once, and not again by the next look."""
        if not session.answers:
            with suppress(Exception):
                self.leave(session)


def _checked(control: Control, interlock: Interlock) -> bool:
    """Stop where that is wanted, or a door is opened; a move by hand is never paused."""
    control.check()
    interlock.check()
    return False
