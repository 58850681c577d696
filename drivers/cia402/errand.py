"""Whether a drive has done what it was told, by a statusword that may lag behind and flicker."""

from typing import Final

from tumble.drivers.cia402 import states

LINGER_S: Final = 1.0
"""How long bits of what was before may stay, in real time; some drives take 0.3 s."""


class Errand:
    """One homing, move or stop of a drive, from its command on.

    The bits that say that it is done may still be those of the errand before. They are believed once they have gone,
    which shows that the drive has begun; where the axis is at the target; or where the axis has not stirred for
    `LINGER_S`. The bits of a homing must both have gone; bit 10 alone may flicker at rest, and for a move has gone only
    where the axis has left its start, too. Once at rest, the drive is at rest as long as it stays there, whatever a
    flickering bit says.

    Parameters
    ----------
    start
        Position at the command, in counts.
    window
        How far an axis at rest may be beside its place, in counts.
    now_s
        The computer's monotonic time of the command.
    target
        Position where it is to end; None where the drive knows that alone.
    homing
        Whether the errand is a homing.
    begun
        Whether what the drive says is of this errand for certain.
    """

    def __init__(
        self,
        start: int,
        window: int,
        now_s: float,
        *,
        target: int | None = None,
        homing: bool = False,
        begun: bool = False,
    ) -> None:
        self._start, self._window, self._target, self._homing = start, window, target, homing
        self.begun = begun
        """Whether the drive has shown that it has begun."""
        self._still, self._still_s = start, now_s
        self._rest: int | None = None

    def homed(self, statusword: int, counts: int, now_s: float) -> bool:
        """Whether it was a homing that has found the reference."""
        return self._homing and self.over(statusword, counts, now_s) and states.is_homed(statusword)

    def over(self, statusword: int, counts: int, now_s: float) -> bool:
        """Whether the axis is at rest at the end of it, by what the drive says now."""
        if not self._near(counts, self._still):
            self._still, self._still_s = counts, now_s
        says = self._says_done(statusword)
        self.begun = self.begun or self._shows_begun(statusword, counts)
        if says and (self.begun or self._proven(counts) or now_s - self._still_s >= LINGER_S):
            self._rest = counts
            return True
        return self._rest is not None and self._near(counts, self._rest)

    def _says_done(self, statusword: int) -> bool:
        failed = statusword & states.MOTION_ERROR and statusword & states.TARGET_REACHED
        done = states.is_homed(statusword) if self._homing else statusword & states.TARGET_REACHED
        return bool(done or failed)

    def _shows_begun(self, statusword: int, counts: int) -> bool:
        if self._homing:
            return not statusword & (states.HOMING_ATTAINED | states.TARGET_REACHED)
        return not statusword & states.TARGET_REACHED and not self._near(counts, self._start)

    def _proven(self, counts: int) -> bool:
        return self._target is not None and self._near(counts, self._target)

    def _near(self, counts: int, place: int) -> bool:
        return abs(counts - place) <= self._window
