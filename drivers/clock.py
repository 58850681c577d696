"""Time as an object, so that a simulated stand runs in virtual time and no test sleeps."""

import time
from typing import Protocol


class Clock(Protocol):
    """A monotonic clock, a wall clock, and a way to wait."""

    def monotonic_s(self) -> float:
        """Seconds from an arbitrary origin; never goes back."""
        ...

    def wall_ns(self) -> int:
        """Nanoseconds since 1970-01-01 UTC; may jump when the computer's clock is set."""
        ...

    def sleep(self, duration_s: float) -> None:
        """Wait; returns at once for zero or less."""
        ...


class SystemClock:
    """The computer's own clock."""

    def monotonic_s(self) -> float:
        """Seconds since the computer started, or thereabouts."""
        return time.monotonic()

    def wall_ns(self) -> int:
        """Nanoseconds since 1970-01-01 UTC."""
        return time.time_ns()

    def sleep(self, duration_s: float) -> None:
        """Wait for `duration_s` seconds."""
        if duration_s > 0:
            time.sleep(duration_s)


class VirtualClock:
    """A clock that only moves when somebody sleeps: an hour at the stand takes no time at all."""

    def __init__(self, wall_start_ns: int | None = None) -> None:
        self._elapsed_s = 0.0
        self._wall_start_ns = time.time_ns() if wall_start_ns is None else wall_start_ns

    def monotonic_s(self) -> float:
        """Seconds slept since the clock was made."""
        return self._elapsed_s

    def wall_ns(self) -> int:
        """Wall time at which the clock was made plus what was slept since."""
        return self._wall_start_ns + round(self._elapsed_s * 1e9)

    def sleep(self, duration_s: float) -> None:
        """Advance by `duration_s` seconds, at once."""
        if duration_s > 0:
            self._elapsed_s += duration_s
