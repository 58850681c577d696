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


class ReleasedClock(VirtualClock):
    """A virtual clock that runs by itself from the moment it is released: what came before took no time."""

    def __init__(self, wall_start_ns: int | None = None) -> None:
        super().__init__(wall_start_ns)
        self._released_s: float | None = None
        self._speed = 1.0

    def release(self, speed: float = 1.0) -> None:
        """Run by the computer's own clock from now on, `speed` times as fast."""
        self._released_s, self._speed = time.monotonic(), speed

    def monotonic_s(self) -> float:
        """Seconds slept until the release, and those that have passed since."""
        since_s = 0.0 if self._released_s is None else (time.monotonic() - self._released_s) * self._speed
        return super().monotonic_s() + since_s

    def wall_ns(self) -> int:
        """Wall time at which the clock was made plus its own time since then."""
        return self._wall_start_ns + round(self.monotonic_s() * 1e9)

    def sleep(self, duration_s: float) -> None:
        """Advance at once before the release; wait after it."""
        if self._released_s is None:
            super().sleep(duration_s)
        elif duration_s > 0:
            time.sleep(duration_s / self._speed)
