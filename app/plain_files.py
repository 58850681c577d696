"""Files in folders into which others may put something too: only what is a plain file of one name is opened.

A link is not followed, a pipe holds nobody up, and whoever writes or empties a file can have it alone for that.
"""

import errno
import os
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Final

from tumble.messages import Message

FLAGS: Final = (
    getattr(os, "O_NOFOLLOW", 0)
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)
)
"""With which such a file is opened."""
_BEHIND = 1 << 20
"""Place of the locked byte: Windows lets nobody read what is locked, and what stands in front of it shall be read."""


def open_plain(path: Path, access: int = os.O_RDWR) -> int:
    """Descriptor of a file that is there. Raises `OSError`, also where it is no plain file of its own."""
    descriptor = os.open(path, access | FLAGS)
    found = os.fstat(descriptor)
    if path.is_symlink() or not stat.S_ISREG(found.st_mode) or found.st_nlink > 1:
        os.close(descriptor)
        raise OSError(errno.EINVAL, Message("it is no plain file of its own"), str(path))
    return descriptor


def is_still(path: Path, stream: IO[bytes]) -> bool:
    """Whether a file that was opened is still the one at its path."""
    try:
        return os.path.samestat(path.lstat(), os.fstat(stream.fileno()))
    except FileNotFoundError:
        return False


if sys.platform == "win32":
    import msvcrt

    def lock(stream: IO[bytes]) -> bool:
        """Have a file alone until it is closed; false where somebody else has it."""
        stream.seek(_BEHIND)
        try:
            msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        return True

    def _unlock(stream: IO[bytes]) -> None:
        stream.seek(_BEHIND)
        msvcrt.locking(stream.fileno(), msvcrt.LK_UNLCK, 1)

else:
    import fcntl

    def lock(stream: IO[bytes]) -> bool:
        """Have a file alone until it is closed; false where somebody else has it."""
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def _unlock(stream: IO[bytes]) -> None:
        fcntl.flock(stream, fcntl.LOCK_UN)


@contextmanager
def alone(stream: IO[bytes]) -> Iterator[bool]:
    """Have an unbuffered file alone until the end, where nobody else has it: yields whether that is so."""
    locked = lock(stream)
    try:
        yield locked
    finally:
        if locked:
            _unlock(stream)
