"""Opening what takes seconds where nobody answers, without keeping whoever stops it waiting."""

from collections.abc import Callable
from concurrent.futures import Future, wait
from threading import Thread
from typing import Final, TypeVar

_SLICE_S: Final = 0.05
"""One wait without a look, in real time."""

Opened = TypeVar("Opened")


def opened_unless_stopped(
    open_it: Callable[[], Opened], check: Callable[[], object], close: Callable[[Opened], object], url: str
) -> Opened:
    """What `open_it` returns, opened in a thread of its own, while `check` is called many times a second.

    What `check` raises ends the wait at once; what is there only afterwards is handed to `close`, in that thread.
    The thread is called after `url`. Raises whatever `open_it` raises.
    """
    opening: Future[Opened] = Future()
    Thread(target=_open, args=(open_it, opening), name=f"opening {url}", daemon=True).start()
    try:
        while not wait((opening,), _SLICE_S).done:
            check()
    except BaseException:
        opening.add_done_callback(lambda late: late.exception() or close(late.result()))
        raise
    return opening.result()


def _open(open_it: Callable[[], Opened], opening: Future[Opened]) -> None:
    try:
        there = open_it()
    except BaseException as error:  # raised where it is waited for
        opening.set_exception(error)
    else:
        opening.set_result(there)
