"""A clock that runs faster than real time, so that a stand that is reached through a wire need not be waited for."""

import time
from typing import TypedDict

from tumble.messages import Message


class Pace(TypedDict):
    """What makes a `FasterClock` the clock that it is, for another process of the same computer."""

    factor: float
    began_s: float
    wall_start_ns: int


class FasterClock:
    """The computer's clock, `factor` times as fast from the moment it is made. Fits `tumble.drivers.clock.Clock`.

    Unlike a virtual clock it runs by itself: several threads, even several processes, may live by such clocks.
    `FasterClock(**clock.pace)` tells the same time as `clock`, also in another process.
    """

    def __init__(self, factor: float = 1.0, began_s: float | None = None, wall_start_ns: int | None = None) -> None:
        if not factor > 0.0:
            raise ValueError(
                Message("a clock cannot run {factor:g} times as fast; give a factor above 0", factor=factor)
            )
        self.factor = factor
        """Times real time."""
        self._began_s = time.monotonic() if began_s is None else began_s
        self._wall_start_ns = time.time_ns() if wall_start_ns is None else wall_start_ns

    @property
    def pace(self) -> Pace:
        """Factor, the computer's monotonic time when it was made, and its wall time then."""
        return Pace(factor=self.factor, began_s=self._began_s, wall_start_ns=self._wall_start_ns)

    def monotonic_s(self) -> float:
        """Seconds since the clock was made, in its own time."""
        return (time.monotonic() - self._began_s) * self.factor

    def wall_ns(self) -> int:
        """Wall time at which the clock was made plus its own time since then."""
        return self._wall_start_ns + round(self.monotonic_s() * 1e9)

    def sleep(self, duration_s: float) -> None:
        """Wait for `duration_s` seconds of the clock's own time."""
        if duration_s > 0:
            time.sleep(duration_s / self.factor)
