"""Signals that stop the program: in a run to a standstill (`tumble.app.running`), anywhere else at once."""

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TypeAlias

from tumble.drivers.errors import Interrupted

STOPPING_SIGNALS = [signal.SIGINT, signal.SIGTERM]
if sys.platform == "win32":
    STOPPING_SIGNALS.append(signal.SIGBREAK)  # sent there where the window of the terminal is closed
elif signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # nohup wants it ignored
    STOPPING_SIGNALS.append(signal.SIGHUP)  # sent where the terminal is closed, or the connection to it lost

Handler: TypeAlias = Callable[[int, FrameType | None], None]


@contextmanager
def handled_by(handler: Handler) -> Iterator[None]:
    """Have `STOPPING_SIGNALS` call `handler`; in another thread than the main one whoever runs it handles them."""
    try:
        before = {number: signal.signal(number, handler) for number in STOPPING_SIGNALS}
    except ValueError:  # not the main thread
        before = {}
    try:
        yield
    finally:
        for number, previous in before.items():
            signal.signal(number, signal.SIG_DFL if previous is None else previous)


@contextmanager
def interrupting() -> Iterator[None]:
    """Have the first of `STOPPING_SIGNALS` raise `Interrupted`, and every SIGINT after it.

    Others after the first are not heeded: they would end what the first one has to be cleared up. Where the exception
    was lost on its way, it is raised at the end.
    """
    first: list[Interrupted] = []

    def interrupt(number: int, _frame: FrameType | None) -> None:
        if first and number != signal.SIGINT:
            return
        first.append(Interrupted(signal.Signals(number).name))
        raise first[-1]

    with handled_by(interrupt):
        yield
        if first:
            raise first[0]
