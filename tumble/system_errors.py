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
    errno.EPIPE: Message("Broken pipe"),
    errno.ECONNREFUSED: Message("Connection refused"),
    errno.ECONNRESET: Message("Connection reset by peer"),
    errno.ETIMEDOUT: Message("Connection timed out"),
    errno.EDQUOT: Message("Disk quota exceeded"),
    errno.EFBIG: Message("File too large"),
    errno.EINVAL: Message("Invalid argument"),
    errno.ENETUNREACH: Message("Network is unreachable"),
    errno.EHOSTUNREACH: Message("No route to host"),
    errno.ENODEV: Message("No such device"),
    errno.ELOOP: Message("Too many levels of symbolic links"),
}
_WITHOUT_NUMBER: Final[Mapping[str, Message]] = {
    "Name or service not known": Message("Name or service not known"),
    "timed out": Message("timed out"),
}
"""What comes without a number of its own, by the words of the C library of Linux."""


def reason(error: OSError) -> str:
    """Why the operating system refused something; a message where it is one of the usual reasons."""
    if isinstance(error.strerror, Message):  # raised by this program, which says more
        return error.strerror
    said: str = error.strerror or str(error)
    return _REASONS.get(error.errno or 0) or _WITHOUT_NUMBER.get(said) or said
