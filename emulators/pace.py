"""When an instrument that sends by itself has something to send."""

from typing import Final

from tumble.drivers.clock import Clock

_MOST_KEPT: Final = 50
"""So many samples are made up for where nobody looked for long; older ones are lost, as in any buffer."""


class Pace:
    """An even rate by the clock of the world."""

    def __init__(self, clock: Clock, rate_hz: float) -> None:
        self._clock, self._rate_hz = clock, rate_hz
        self._began_s = clock.monotonic_s()
        self._sent = 0

    def due(self) -> int:
        """How many samples have become due since the last call."""
        so_far = int((self._clock.monotonic_s() - self._began_s) * self._rate_hz + 1e-6)
        due, self._sent = so_far - self._sent, so_far
        return min(due, _MOST_KEPT)
