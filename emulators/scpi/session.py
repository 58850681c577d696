"""A client's conversation with an instrument."""

from collections import deque
from collections.abc import Generator
from threading import RLock
from typing import Protocol

from tumble.emulators.scpi.language import ScpiError
from tumble.emulators.scpi.status import Status

INTERRUPTED = -410


class Instrument(Protocol):
    """A multimeter, or whatever else speaks SCPI."""

    status: Status

    @property
    def lock(self) -> RLock:
        """Held by whoever lets it work."""
        ...

    @property
    def deaf(self) -> bool:
        """Whether it reads nothing but ABORt at the moment."""
        ...

    def abort(self) -> None:
        """End what it is at."""
        ...

    def execute(self, message: str) -> Generator[None, None, str]:
        """Carry out a message; yields while a query waits, and returns the answers."""
        ...


class ScpiSession:
    """Messages in, answers out. Fits `tumble.emulators.serving.Session`.

    A query that waits for readings is answered by `due`. A message that comes before that interrupts it: the answer
    never comes (IEEE 488.2-1992, 6.3.2.3). Where no query waits, or the meter is deaf while it measures, it is heard
    afterwards.
    """

    def __init__(self, meter: Instrument) -> None:
        self._meter = meter
        self._running: Generator[None, None, str] | None = None
        self._asked = False
        self._unheard: deque[str] = deque()

    def received(self, data: bytes) -> bytes:
        """Hear one message, its terminator included."""
        message = data.decode("latin-1").strip()
        if not message:
            return self.due()
        if self._running and (self._meter.deaf or not self._asked):
            if message.lstrip(":").upper().startswith("ABOR"):
                self._meter.abort()
            self._unheard.append(message)
            return self.due()
        if self._running:
            self._meter.status.report(ScpiError(INTERRUPTED))
        self._running = self._meter.execute(message)
        self._asked = "?" in message
        return self.due()

    def due(self) -> bytes:
        """The answer for which the client waits, once it is there."""
        if self._running is None:
            return b""
        with self._meter.lock:
            try:
                next(self._running)
            except StopIteration as finished:
                self._running = None
                answer: str = finished.value
                return (f"{answer}\n".encode("ascii") if answer else b"") + self._next()
        return b""

    def _next(self) -> bytes:
        """What comes of a message that was not heard before."""
        return self.received(self._unheard.popleft().encode("latin-1")) if self._unheard else b""
