"""Where a run stands, and that everybody hears of it."""

from tumble.procedures.announcer import Announcer
from tumble.procedures.events import State, StateChanged


class Phase:
    """The state of a run; each change is announced."""

    def __init__(self, announcer: Announcer) -> None:
        self._announcer = announcer
        self.state = State.IDLE
        """Where the run stands."""

    def change(self, state: State) -> None:
        """Enter `state`. Raises `StorageError`."""
        self.state = state
        self._announcer.announce(StateChanged(state=state))

    def change_anyway(self, state: State, reason: str) -> None:
        """Enter `state` even where the sink fails, and say why."""
        self.state = state
        self._announcer.announce_anyway(StateChanged(state=state, reason=reason))
