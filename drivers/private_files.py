"""Small files between programs of one user: nobody else can have written them, and no link leads elsewhere."""

import os
import stat
import sys
from pathlib import Path
from typing import Final

from tumble.messages import Message

_LARGEST: Final = 4096
_NO_LINK: Final = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""Windows knows neither; a user's folder there is closed to others by its access list."""
_WITH_OWNERS: Final = sys.platform != "win32"


def state_folder() -> Path:
    """Where a program keeps what is neither a setting nor data (XDG Base Directory Specification; Windows likewise)."""
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "tumble"
    return Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state") / "tumble"


def private_folder(name: str) -> Path:
    """A folder of the user's own in `state_folder`, made where there is none. Raises `OSError`."""
    folder = state_folder() / name
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    if not _ours(folder.lstat(), stat.S_IFDIR):
        raise PermissionError(Message("{folder} is a link, or another user's; take it away", folder=folder))
    if sys.platform != "win32":
        folder.chmod(0o700)
    return folder


def write_private(path: Path, text: str) -> None:
    """Write a file that only the user can read, in the place of whatever has its name. Raises `OSError`."""
    path.unlink(missing_ok=True)
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | _NO_LINK, 0o600)
    with os.fdopen(descriptor, "w", encoding="utf-8") as stream:
        stream.write(text)


def read_private(path: Path) -> str:
    """Text of such a file. Raises `OSError` where it is a link, another user's or open to others, `ValueError`."""
    with os.fdopen(os.open(path, os.O_RDONLY | _NO_LINK), "rb") as stream:
        found = os.fstat(stream.fileno())
        if path.is_symlink() or not _ours(found, stat.S_IFREG) or (_WITH_OWNERS and found.st_mode & 0o077):
            raise PermissionError(Message("{path} is not the user's own", path=path))
        return stream.read(_LARGEST).decode("utf-8")


def _ours(found: os.stat_result, kind: int) -> bool:
    """Whether a file is of a kind, and the user's."""
    return stat.S_IFMT(found.st_mode) == kind and (sys.platform == "win32" or found.st_uid == os.geteuid())
