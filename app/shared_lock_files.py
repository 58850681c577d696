"""Files that every user of the computer may open and lock, in a folder where nobody may take away another's.

On Linux that is a folder with the sticky bit (FHS 3.0, /run/lock; hier(7)), on Windows one in ProgramData. Anybody may
put something there: what is no plain file of its own is refused, and a link is not followed.
"""

import errno
import os
import stat
import sys
from pathlib import Path
from typing import IO, Final

from tumble.app.exits import Exit, JobError
from tumble.messages import Message

FOLDERS: Final = ("/run/lock", "/var/lock", "/tmp")
"""The first of these that all may write to; not TMPDIR, which may be another for each user."""
_FOR_ALL: Final = 0o1777
_ANYBODY: Final = 0o666
_FLAGS: Final = (
    getattr(os, "O_NOFOLLOW", 0)
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)
)


def lock_folder() -> Path:
    """The folder in which all users of this computer lock a stand. Raises `JobError` where there is none."""
    if sys.platform == "win32":
        folder = Path(os.environ.get("PROGRAMDATA") or r"C:\ProgramData") / "tumble" / "locks"
        folder.mkdir(parents=True, exist_ok=True)
        return folder
    for name in FOLDERS:
        folder = Path(name).resolve()
        if folder.is_dir() and stat.S_IMODE(folder.stat().st_mode) == _FOR_ALL:
            return folder
    raise JobError(
        Message(
            "none of {folders} is a folder that all users may write to (mode 1777), so that a stand cannot be "
            "kept from others; have one made",
            folders=", ".join(FOLDERS),
        ),
        Exit.DEVICE_FAULT,
    )


def open_shared(path: Path) -> IO[bytes]:
    """Open a file for reading and writing, or where it is another's for reading; make it where there is none.

    Raises
    ------
    FileExistsError
        Somebody made it meanwhile; try again.
    OSError
        It is no file that can be locked, or it may not be opened.
    """
    try:
        descriptor, mode = os.open(path, os.O_RDWR | _FLAGS), "r+b"
    except FileNotFoundError:
        return _made(path)
    except PermissionError:
        descriptor, mode = os.open(path, os.O_RDONLY | _FLAGS), "rb"
    found = os.fstat(descriptor)
    if path.is_symlink() or not stat.S_ISREG(found.st_mode) or found.st_nlink > 1:
        os.close(descriptor)
        raise OSError(errno.EINVAL, Message("it is no plain file of its own"), str(path))
    return os.fdopen(descriptor, mode)


def _made(path: Path) -> IO[bytes]:
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | _FLAGS, _ANYBODY)
    if sys.platform != "win32":
        os.fchmod(descriptor, _ANYBODY)  # whatever the user's mask: the next one must be able to lock it
    return os.fdopen(descriptor, "w+b")
