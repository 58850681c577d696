"""The one way from the thread of a run into the event loop."""

import time
from typing import Final

from PySide6.QtCore import QObject, Signal

from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.events import ConditionAnswered, Event, PointCompleted
from tumble.procedures.progress import Progress, TimeLeft

_LOOKS_S: Final = 0.04
"""Least real time between two sights of a moving positioner that are passed on."""


class EventBridge(QObject):
    """A listener whose signals arrive in the thread of whoever is connected."""

    announced = Signal(object)
    """Every event of a run."""
    position_seen = Signal(str, object)
    """Name and `PositionerStatus` of a positioner on its way; not every one."""
    progressed = Signal(int, object)
    """Points done, and the `TimeLeft`."""
    failed = Signal(object)
    """What went wrong in counting; the run goes on without."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._looked_s: dict[str, float] = {}
        self._progress: Progress | None = None

    def count(self, progress: Progress) -> None:
        """Have a run counted that is about to begin."""
        self._progress = progress

    def listen(self, event: Event) -> None:
        """Pass an event on; called in the thread of the run, which would no longer serve a listener that raises."""
        self.announced.emit(event)
        try:
            self._count(event)
        except Exception as error:
            self._progress = None
            self.failed.emit(error)

    def _count(self, event: Event) -> None:
        if self._progress is None:
            return
        self._progress(event)
        if isinstance(event, PointCompleted | ConditionAnswered):
            left: TimeLeft = self._progress.time_left()
            self.progressed.emit(self._progress.done, left)

    def look(self, name: str, status: PositionerStatus) -> None:
        """Pass on where a positioner is, as often as an eye can follow."""
        now_s = time.monotonic()
        if not status.moving or now_s - self._looked_s.get(name, 0.0) >= _LOOKS_S:
            self._looked_s[name] = now_s
            self.position_seen.emit(name, status)
