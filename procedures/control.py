"""Pausing and stopping a run from another thread, and having its last point taken again."""

from collections import deque
from threading import Event

from tumble.messages import Message
from tumble.procedures.errors import StopRequestedError


class Control:
    """What somebody outside wants of a run. Every method may be called from any thread."""

    def __init__(self) -> None:
        self._pause = Event()
        self._stop = Event()
        self._again: deque[int] = deque(maxlen=1)
        self._why: str = Message("the operator stopped the run")

    def pause_wanted(self) -> bool:
        """Whether the run should pause, or stay paused."""
        return self._pause.is_set()

    def pause(self) -> None:
        """Ask for a pause."""
        self._pause.set()

    def resume(self) -> None:
        """Take back a pause."""
        self._pause.clear()

    def take_again(self, point: int) -> None:
        """Ask for the last point to be measured once more; `point` is its number, from 0."""
        self._again.append(point)

    def heed_again(self) -> int | None:
        """Which point was asked for; None where none was since this was called the last time."""
        return self._again.pop() if self._again else None

    def stop(self, why: str = "") -> None:
        """Ask for the end of the run, `why` where it is not the operator's wish; this cannot be taken back."""
        self._why = why or self._why
        self._stop.set()

    def stop_wanted(self) -> bool:
        """Whether the run should end."""
        return self._stop.is_set()

    def check(self) -> None:
        """Raise `StopRequestedError` where the run should end."""
        if self.stop_wanted():
            raise StopRequestedError(self._why)
