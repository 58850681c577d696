"""Which windows of a store are open: each has a lock file of its own there, which it refreshes while it is.

Qt's lock files hold on Linux and on Windows, and one whose process has died on this computer is taken over. Of another
computer's nobody here knows the processes: a lock that is not refreshed any more belongs there to one that is gone.
How long that is, this computer's clock alone says, since the other one may go wrong.
"""

import os
from pathlib import Path
from time import monotonic
from typing import Final

from PySide6.QtCore import QLockFile, QSysInfo

_GONE_S: Final = 60.0
"""Without a sign of life for so long, a window on another computer is gone."""


class Presence:
    """Shows other windows of a store that this one is open, and sees which of the others are.

    Parameters
    ----------
    folder
        Store.
    owner
        Name of this window; letters and digits.
    """

    def __init__(self, folder: Path, owner: str) -> None:
        self._folder, self._owner = folder, owner
        self._own = _lock_file(self._path_of(owner))
        self._signs: dict[str, tuple[int, float]] = {}
        """The last sign of life of each window on another computer, and when it was first seen here."""

    def show(self) -> None:
        """Be seen from now on."""
        if not self._own.isLocked():
            self._own.tryLock(0)

    def refresh(self) -> None:
        """Give a sign of life, where this window is to be seen."""
        if not self._own.isLocked():
            return
        try:
            os.utime(self._own.fileName())
        except FileNotFoundError:  # taken for gone, as after a long sleep
            self._own.unlock()
            self._own.tryLock(0)
        except OSError:
            return

    def leave(self) -> None:
        """Be seen no more."""
        self._own.unlock()

    def sweep(self) -> None:
        """Remove the locks of windows that died on this computer."""
        for path in self._folder.glob("queue-*.lock"):
            lock = _lock_file(path)
            if lock.tryLock(0):
                lock.unlock()

    def is_open(self, owner: str) -> bool:
        """Whether the window of a name is open."""
        if owner == self._owner:
            return True
        if not owner.isalnum():
            return False
        lock = _lock_file(self._path_of(owner))
        if lock.tryLock(0):
            lock.unlock()
            return False
        return is_held(lock) and (_is_here(lock) or self._shows_life(owner))

    def _shows_life(self, owner: str) -> bool:
        try:
            sign = self._path_of(owner).stat().st_mtime_ns
        except OSError:
            return False
        if owner not in self._signs or self._signs[owner][0] != sign:
            self._signs[owner] = (sign, monotonic())
        return monotonic() - self._signs[owner][1] < _GONE_S

    def _path_of(self, owner: str) -> Path:
        return self._folder / f"queue-{owner}.lock"


def is_held(lock: QLockFile) -> bool:
    """Whether a lock is another's, where it could not be had; it may be that the folder takes none."""
    return lock.error() is QLockFile.LockError.LockFailedError


def _is_here(lock: QLockFile) -> bool:
    """Whether the process that holds a lock is one of this computer."""
    _, host, _ = lock.getLockInfo()
    return bool(host == QSysInfo.machineHostName())


def _lock_file(path: Path) -> QLockFile:
    """A lock that is given up by the death of its process alone."""
    lock = QLockFile(str(path))
    lock.setStaleLockTime(0)
    return lock
