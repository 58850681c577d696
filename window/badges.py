"""Which badges the rail wears: what is to be seen of a screen from every other one."""

from tumble.window.look.language import tr
from tumble.window.look.tints import AMBER, BLUE, GREEN, GREY, RED, VIOLET
from tumble.window.screens.run_state import Mood
from tumble.window.widgets.rail import Badge, Rail

STAND, RUN, RESULT, RECORDS, SETTINGS, HELP = range(6)
"""Places of the rail, in its order."""


class Badges:
    """Says at the rail who is connected, what a run does, whether a result was not looked at, and what broke off."""

    def __init__(self, rail: Rail) -> None:
        self._rail = rail

    def show_connected(self, connected: bool) -> None:
        """Whether the stand answers."""
        self._rail.wear(STAND, Badge(sign="✓", tint=GREEN, meaning=tr("connected")) if connected else None)

    def show_mood(self, mood: Mood, state: str) -> None:
        """What the run does, in the words of its state."""
        sign, tint = {
            Mood.READY: ("", GREY),
            Mood.MEASURING: ("▸", BLUE),
            Mood.WAITING: ("!", AMBER),
            Mood.PAUSED: ("‖", VIOLET),
            Mood.FAULT: ("✗", RED),
        }[mood]
        self._rail.wear(RUN, Badge(sign=sign, tint=tint, meaning=state) if sign else None)

    def show_result(self, seen: bool) -> None:
        """Whether there is a result that nobody has looked at."""
        badge = Badge(sign="1", tint=GREEN, meaning=tr("a new result"))
        self._rail.wear(RESULT, None if seen else badge)

    def show_cut_off(self, count: int) -> None:
        """How many runs came to no record."""
        badge = Badge(sign=str(min(count, 99)), tint=GREY, meaning=tr("{count} without a record", count=count))
        self._rail.wear(RECORDS, badge if count else None)
