"""Analysis and storage outside the event loop."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial
from typing import TypeVar

from PySide6.QtCore import QObject, Signal, Slot

Result = TypeVar("Result")


class Background(QObject):
    """Calls functions in one thread of its own, in their order, and passes on what came of them in the event loop."""

    busy = Signal(bool)
    """Whether anything is under way."""
    failed = Signal(object)
    """An exception that nobody said what to do about."""
    _arrived = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._executor = ThreadPoolExecutor(max_workers=1, thread_name_prefix="analysis")
        self._under_way = 0
        self._left = False
        self._arrived.connect(self._deliver)

    def start(
        self,
        function: Callable[[], Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None] | None = None,
    ) -> None:
        """Call `function` in the other thread, and `done` or `failed` here with what came of it."""
        if self._left:
            return
        self._under_way += 1
        self.busy.emit(True)
        future = self._executor.submit(function)
        future.add_done_callback(lambda ended: self._arrived.emit(partial(self._conclude, ended, done, failed)))

    @property
    def is_busy(self) -> bool:
        """Whether anything is under way."""
        return self._under_way > 0

    def leave(self) -> None:
        """Begin nothing more, and wait for what is under way: it may be writing."""
        self._left = True
        self._arrived.disconnect(self._deliver)
        self._executor.shutdown(wait=True, cancel_futures=True)

    @Slot(object)
    def _deliver(self, arrived: Callable[[], None]) -> None:
        self._under_way -= 1
        self.busy.emit(self._under_way > 0)
        arrived()

    def _conclude(
        self,
        future: Future[Result],
        done: Callable[[Result], None],
        failed: Callable[[Exception], None] | None,
    ) -> None:
        error = future.exception()
        if error is None:
            done(future.result())
        elif isinstance(error, Exception):
            (failed or self.failed.emit)(error)
        else:
            raise error
