"""A thread that carries out orders and cannot die of them."""

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Final

Done = Callable[[BaseException | None], None]

_IDLE_S: Final = 0.2
"""Between two turns of what is done while there are no orders."""


class OrderThread:
    """Carries out one order after the other, and something else now and then while there is none.

    Parameters
    ----------
    post
        Has a function called in the event loop; from any thread.
    idle
        What is done between orders, and who hears in the event loop what that raised.
    """

    def __init__(self, post: Callable[[Callable[[], None]], None], idle: tuple[Callable[[], object], Done]) -> None:
        self._post, self._idle = post, idle
        self._orders: SimpleQueue[tuple[Callable[[], object], Done] | None] = SimpleQueue()
        self._thread = Thread(target=self._work, name="stand", daemon=True)
        self._thread.start()

    def put(self, action: Callable[[], object], done: Done) -> None:
        """Have `action` called after everything before it, and `done` in the event loop with what it raised."""
        self._orders.put((action, done))

    @property
    def is_wanted(self) -> bool:
        """Whether an order waits; from any thread."""
        return not self._orders.empty()

    def end(self) -> None:
        """Carry out what waits, and end; returns when that is done."""
        self._orders.put(None)
        self._thread.join()

    def _work(self) -> None:
        while True:
            try:
                order = self._orders.get(timeout=_IDLE_S)
            except Empty:
                if error := _attempt(self._idle[0]):
                    self._pass_on(self._idle[1], error)
                continue
            if order is None:
                return
            action, done = order
            self._pass_on(done, _attempt(action))

    def _pass_on(self, done: Done, error: BaseException | None) -> None:
        with suppress(RuntimeError):  # the event loop is no more: the window was closed
            self._post(partial(done, error))


def _attempt(action: Callable[[], object]) -> BaseException | None:
    """Whatever it raises, be it that a driver wants to end the program, is for the person to see."""
    try:
        action()
    except BaseException as error:
        return error
    return None
