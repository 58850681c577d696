"""Files that are read whole, within bounds: what is named may be a device without an end, or the image of a disk."""

import errno
import stat
from pathlib import Path
from typing import Final

from tumble.messages import Message

LARGEST_TABLE: Final = 256 * 2**20
"""Bytes; a table of a million rows has some 80 million."""
MOST_ROWS: Final = 2_000_000
"""A table of a million takes 1.3 GB while it is read."""


def check_bounded(path: Path, most_bytes: int = LARGEST_TABLE) -> None:
    """Raise `OSError`, in words, for a device or a pipe, and for a file of more than `most_bytes`."""
    there = path.stat()
    if not (stat.S_ISREG(there.st_mode) or stat.S_ISDIR(there.st_mode)):
        raise OSError(errno.EINVAL, Message("no file but a device or a pipe, which may have no end"))
    if there.st_size > most_bytes:
        raise OSError(
            errno.EFBIG,
            Message(
                "{size_mib:,.0f} MiB, where at most {most_mib:.0f} are read",
                size_mib=there.st_size / 2**20,
                most_mib=most_bytes / 2**20,
            ),
        )


def read_bounded(path: Path, most_bytes: int = LARGEST_TABLE) -> bytes:
    """Contents of a file. Raises `OSError`, also as `check_bounded`."""
    check_bounded(path, most_bytes)
    return path.read_bytes()
