"""Pausing and stopping a run from another thread."""

from threading import Event

from tumble.messages import Message
from tumble.procedures.errors import StopRequestedError


class Control:
    """What somebody outside wants of a run. Every method may be called from any thread."""

    def __init__(self) -> None:
        self._pause = Event()
        self._stop = Event()

    def pause_wanted(self) -> bool:
        """Whether the run should pause, or stay paused."""
        return self._pause.is_set()

    def pause(self) -> None:
        """Ask for a pause."""
        self._pause.set()

    def resume(self) -> None:
        """Take back a pause."""
        self._pause.clear()

    def stop(self) -> None:
        """Ask for the end of the run; this cannot be taken back."""
        self._stop.set()

    def stop_wanted(self) -> bool:
        """Whether the run should end."""
        return self._stop.is_set()

    def check(self) -> None:
        """Raise `StopRequestedError` where the run should end."""
        if self.stop_wanted():
            raise StopRequestedError(Message("the operator stopped the run"))
