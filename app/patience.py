"""A pause at a stand that takes no time."""

import time
from typing import Final

from tumble.procedures.control import Control

_BLINK_S: Final = 0.02


class PatientControl(Control):
    """The engine waits by the clock of the stand; where that takes no time, a pause would be a spin."""

    def pause_wanted(self) -> bool:
        """Whether the run should pause, or stay paused; says so in no hurry."""
        wanted = super().pause_wanted()
        if wanted:
            time.sleep(_BLINK_S)
        return wanted
