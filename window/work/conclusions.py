"""What is made of runs, beside whatever the stand does meanwhile."""

from functools import partial

from PySide6.QtCore import QObject, Signal

from tumble.window.work.activity import Activity, Concluded, Conclusion
from tumble.window.work.background import Background


class Conclusions(QObject):
    """Analyses and stores one run after the other, in the order in which they were measured."""

    stage = Signal(str)
    """What the analysis that is under way does now."""
    concluded = Signal(object, object)
    """`Activity` and `Concluded`."""
    failed = Signal(object, object)
    """`Activity` and the exception that ended its analysis."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._background = Background(self)
        self.waiting: list[Activity] = []
        """Runs that have no result yet, in their order."""

    def add(self, activity: Activity, conclusion: Conclusion) -> None:
        """Have what was measured concluded once everything before it is."""
        self.waiting.append(activity)
        self._background.start(
            partial(conclusion, self.stage.emit), partial(self._conclude, activity), partial(self._fail, activity)
        )

    def leave(self) -> None:
        """Begin nothing more, and wait for what is under way: it may be writing."""
        self._background.leave()

    def _conclude(self, activity: Activity, concluded: Concluded) -> None:
        self.waiting.remove(activity)
        self.concluded.emit(activity, concluded)

    def _fail(self, activity: Activity, error: Exception) -> None:
        self.waiting.remove(activity)
        self.failed.emit(activity, error)
