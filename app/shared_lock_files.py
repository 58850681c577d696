"""Files that every user of the computer may open and lock, in a folder where nobody may take away another's.

On Linux that is a folder with the sticky bit (FHS 3.0, /run/lock; hier(7)), on Windows one in ProgramData. Anybody may
put something there: what is no plain file of its own is refused, and a link is not followed.
"""

import os
import stat
import sys
from pathlib import Path
from typing import IO, Final

from tumble.app.exits import Exit, JobError
from tumble.app.plain_files import FLAGS, open_plain
from tumble.messages import Message

FOLDERS: Final = ("/run/lock", "/var/lock", "/tmp")
"""The first of these that all may write to; not TMPDIR, which may be another for each user."""
_FOR_ALL: Final = 0o1777
_ANYBODY: Final = 0o666


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
        descriptor, mode = open_plain(path), "r+b"
    except FileNotFoundError:
        return _made(path)
    except PermissionError:
        descriptor, mode = open_plain(path, os.O_RDONLY), "rb"
    return os.fdopen(descriptor, mode)


def _made(path: Path) -> IO[bytes]:
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | FLAGS, _ANYBODY)
    if sys.platform != "win32":
        os.fchmod(descriptor, _ANYBODY)  # whatever the user's mask: the next one must be able to lock it
    return os.fdopen(descriptor, "w+b")
