"""Of several wishes of the same kind only the newest is of use."""

from collections.abc import Callable
from functools import partial
from typing import Any, TypeAlias

from tumble.window.work.background import Background

_Wish: TypeAlias = tuple[Callable[[], Any], Callable[[Any], None]]


class Newest:
    """Has one call under way at a time, and after it the one that was wanted last meanwhile, those between left out.

    What comes of a call is passed on unless another one was wanted since. Nobody waits: the first one begins at once.
    """

    def __init__(self, background: Background) -> None:
        self._background = background
        self._going = False
        self._next: _Wish | None = None

    def start(self, function: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Call `function` outside of the event loop, and `done` here with what came of it."""
        if self._going:
            self._next = (function, done)
            return
        self._going = True
        self._background.start(function, partial(self._end, done), partial(self._end, self._background.failed.emit))

    def _end(self, tell: Callable[[Any], None], came: object) -> None:
        self._going = False
        wanted, self._next = self._next, None
        if wanted is None:
            tell(came)
        else:
            self.start(*wanted)
