"""What has gone wrong, as an instrument remembers it: error queue and status registers."""

from collections import deque
from collections.abc import Callable
from typing import TypeVar

from tumble.emulators.scpi.language import ScpiError

_T = TypeVar("_T")
LONGEST_QUEUE = 20

_OPERATION_COMPLETE = 1 << 0
_POWER_ON = 1 << 7
_BITS = {1: 1 << 5, 2: 1 << 4, 3: 1 << 3, 4: 1 << 2}
"""Hundreds of an error number to its bit: command, execution, device-specific, query (IEEE 488.2-1992, 11.5.1.1)."""


class Status:
    """Error queue, standard event register with its enabling mask, and the status byte made of them."""

    def __init__(self) -> None:
        self._errors: deque[ScpiError] = deque()
        self._events = _POWER_ON
        self.enabled = 0
        """`*ESE`."""
        self.requests = 0
        """`*SRE`."""
        self.buffer_full = False
        """Summary of measurement events (bit 0 of the status byte of Keithley instruments)."""

    def power_on(self) -> None:
        """Begin anew."""
        self.clear()
        self._events, self.enabled = _POWER_ON, 0

    def attempt(self, act: Callable[[], _T]) -> _T | None:
        """Do something; report what cannot be done. Raises `ScpiError` for what cannot be understood."""
        try:
            return act()
        except ScpiError as error:
            if error.number > -200:
                raise
            self.report(error)
            return None

    def report(self, error: ScpiError) -> None:
        """Put an error into the queue; once that is full, the last says so (SCPI-1999, volume 2, 21.8.1)."""
        self._events |= _BITS[-error.number // 100]
        if len(self._errors) < LONGEST_QUEUE:
            self._errors.append(error)
        else:
            self._errors[-1] = ScpiError(-350)

    def complete(self) -> None:
        """Note that operations are complete."""
        self._events |= _OPERATION_COMPLETE

    def take_error(self) -> str:
        """The oldest error, or that there is none."""
        return str(self._errors.popleft() if self._errors else ScpiError(0))

    def take_events(self) -> int:
        """The event register, which is cleared by reading."""
        events, self._events = self._events, 0
        return events

    @property
    def byte(self) -> int:
        """Status byte: error queue not empty (bit 2), enabled event (bit 5) (SCPI-1999, volume 1, 9), buffer full (bit
        0), and whether any of these requests service (bit 6).
        """
        event = 1 << 5 if self._events & self.enabled else 0
        bits = int(self.buffer_full) | (1 << 2 if self._errors else 0) | event
        return bits | (1 << 6 if bits & self.requests else 0)

    def clear(self) -> None:
        """Forget errors and events."""
        self._errors.clear()
        self._events = 0
        self.buffer_full = False
