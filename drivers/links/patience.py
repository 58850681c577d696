"""Trying again what failed for a moment only."""

import errno
import time
from collections.abc import Callable, Iterator
from typing import Final, TypeVar

from tumble.messages import Message

PAUSE_S: Final = 0.005
"""Between two tries, in real time."""

_PASSING: Final = {
    errno.EINTR,
    errno.EAGAIN,
    errno.EWOULDBLOCK,
    errno.EALREADY,
    errno.EINPROGRESS,
    errno.ENOBUFS,
    errno.ENOMEM,
    *(number for name in ("WSAEWOULDBLOCK", "WSAENOBUFS", "WSAEINTR") if (number := getattr(errno, name, None))),
}
_GONE: Final = {
    errno.ENODEV,
    errno.ENXIO,
    errno.EBADF,
    errno.EPIPE,
    errno.ECONNRESET,
    errno.ECONNABORTED,
    errno.ENOTCONN,
    errno.ESHUTDOWN,
}

Result = TypeVar("Result")


def is_passing(error: BaseException) -> bool:
    """Whether the system says that the same may go well a moment later, or a terminal just would not be set."""
    return any(_number(cause) in _PASSING or type(cause).__module__ == "termios" for cause in _causes(error))


def is_gone(error: BaseException) -> bool:
    """Whether the system says that what was used is no longer there: no use in trying again."""
    return any(isinstance(cause, ConnectionError) or _number(cause) in _GONE for cause in _causes(error))


def patiently(action: Callable[[], Result], granted_s: float, bearable: Callable[[Exception], bool]) -> Result:
    """Carry out `action`, again where it fails in a way that is `bearable`, for `granted_s` real seconds.

    Raises whatever it raises last.
    """
    deadline_s = time.monotonic() + granted_s
    while True:
        try:
            return action()
        except Exception as error:
            if time.monotonic() > deadline_s or not bearable(error):
                raise
        time.sleep(PAUSE_S)


def in_words(error: BaseException) -> str:
    """Why something failed; the kind of error too, where that says more than its text."""
    text = str(error)
    if text and isinstance(error, OSError):
        return text
    return Message("{kind}: {text}", kind=type(error).__name__, text=text) if text else type(error).__name__


def _causes(error: BaseException | None) -> Iterator[BaseException]:
    """An error and those from which it was made."""
    while error is not None:
        yield error
        error = error.__cause__ or error.__context__


def _number(error: BaseException) -> int | None:
    """Number that the system gives an error; `termios` keeps it elsewhere."""
    first = error.args[0] if type(error).__module__ == "termios" and error.args else None
    number = error.errno if isinstance(error, OSError) else first
    return number if isinstance(number, int) else None
