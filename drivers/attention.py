"""What is looked at while something of an instrument is awaited."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import ceil
from typing import Final

from tumble.drivers.clock import Clock

_SLICE_S: Final = 0.05
"""One wait without a look, by the clock that waits."""


class Attention:
    """Has the wait for an instrument broken off: whoever waits calls `check` many times a second.

    A sampler moves nothing, so its answer can be done without. So can the answer of what moves, where its messages are
    numbered: while attention is paid to somebody, whoever ends the wait has everything braked after it.
    """

    def __init__(self) -> None:
        self._check: Callable[[], object] = lambda: None

    def check(self) -> None:
        """Raise whatever whoever is listened to raises now; nothing where nobody is."""
        self._check()

    @contextmanager
    def paid_to(self, check: Callable[[], object]) -> Iterator[None]:
        """Listen to `check`, which may raise, until the end; then to whoever was listened to before."""
        before, self._check = self._check, check
        try:
            yield
        finally:
            self._check = before


class AttentiveClock:
    """Another clock, whose waits `check` is called in many times a second. Fits `Clock`."""

    def __init__(self, clock: Clock, check: Callable[[], object]) -> None:
        self._clock, self._check = clock, check

    def monotonic_s(self) -> float:
        """As the other clock."""
        return self._clock.monotonic_s()

    def wall_ns(self) -> int:
        """As the other clock."""
        return self._clock.wall_ns()

    def sleep(self, duration_s: float) -> None:
        """Wait, in short waits. What `check` raises breaks it off."""
        until_s = self._clock.monotonic_s() + duration_s
        for _ in range(ceil(duration_s / _SLICE_S)):
            self._check()
            self._clock.sleep(min(until_s - self._clock.monotonic_s(), _SLICE_S))
