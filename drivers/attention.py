"""What is looked at while the answer of an instrument is awaited."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager


class Attention:
    """Has the wait for a sampler's answer broken off: whoever waits calls `check` many times a second.

    A sampler moves nothing, so its answer can be done without; the answer of what moves is awaited in any case.
    """

    def __init__(self) -> None:
        self._check: Callable[[], object] = lambda: None

    def check(self) -> None:
        """Raise whatever whoever is listened to raises now; nothing where nobody is."""
        self._check()

    @contextmanager
    def paid_to(self, check: Callable[[], object]) -> Iterator[None]:
        """Listen to `check`, which may raise, until the end; then to whoever was listened to before."""
        before, self._check = self._check, check
        try:
            yield
        finally:
            self._check = before
