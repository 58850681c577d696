"""Reasons of the operating system as messages."""

import errno
from collections.abc import Mapping
from typing import Final

from tumble.messages import Message

_REASONS: Final[Mapping[int, Message]] = {
    errno.ENOENT: Message("No such file or directory"),
    errno.EACCES: Message("Permission denied"),
    errno.EPERM: Message("Operation not permitted"),
    errno.EEXIST: Message("File exists"),
    errno.EISDIR: Message("Is a directory"),
    errno.ENOTDIR: Message("Not a directory"),
    errno.ENOSPC: Message("No space left on device"),
    errno.EROFS: Message("Read-only file system"),
    errno.EBUSY: Message("Device or resource busy"),
    errno.EIO: Message("Input/output error"),
    errno.ENAMETOOLONG: Message("File name too long"),
}


def reason(error: OSError) -> str:
    """Why the operating system refused something; a message where it is one of the usual reasons."""
    if isinstance(error.strerror, Message):  # raised by this program, which says more
        return error.strerror
    return _REASONS.get(error.errno or 0) or error.strerror or str(error)
