"""What the exit status of `tumble` says, and which exception means which."""

import errno
from enum import IntEnum

from tumble.calibrations.records.errors import RecordError, StoreError
from tumble.drivers.errors import DeviceError
from tumble.messages import Message
from tumble.procedures.errors import InputError, StorageError
from tumble.system_errors import reason


class Exit(IntEnum):
    """Exit status of every command."""

    GOOD = 0
    LIMITS_NOT_MET = 1
    """Or nothing could be decided of them."""
    BAD_INPUT = 2
    """Also wrong usage, and a prompt that nobody answered."""
    DEVICE_FAULT = 3
    STOPPED = 4
    STORAGE = 5
    INTERNAL = 70
    """A fault of the program (EX_SOFTWARE of sysexits.h)."""


class JobError(Exception):
    """A job that ended early; carries its exit status and, where there is one, the recording that was kept."""

    def __init__(self, message: str, status: Exit) -> None:
        super().__init__(message)
        self.status = status


_NO_ROOM = {errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EFBIG, errno.EIO}
_NO_SUCH_FILE = {
    errno.ENOENT,
    errno.EACCES,
    errno.EPERM,
    errno.EISDIR,
    errno.ENOTDIR,
    errno.ENAMETOOLONG,
    errno.ELOOP,
    errno.EINVAL,
}


def status_of(error: Exception) -> Exit | None:
    """Exit status for an exception that a user can do something about; None for a fault of the program."""
    kinds: list[tuple[type[Exception], Exit]] = [
        (DeviceError, Exit.DEVICE_FAULT),
        (StorageError, Exit.STORAGE),
        (StoreError, Exit.STORAGE),
        (InputError, Exit.BAD_INPUT),
        (RecordError, Exit.BAD_INPUT),
    ]
    if isinstance(error, JobError):
        return error.status
    if isinstance(error, OSError):
        return _status_of_system(error)
    return next((status for kind, status in kinds if isinstance(error, kind)), None)


def sentence_of(error: Exception) -> str:
    """What an exception says; one of the system says which file it is about, and what to do."""
    if not isinstance(error, OSError):
        return str(error)
    full = error.errno in _NO_ROOM
    return Message(
        "{place}: {reason}; {remedy}",
        place=Message("standard output") if error.filename is None else str(error.filename),
        reason=reason(error),
        remedy=Message("make room or choose another") if full else Message("give a file that can be used"),
    )


def _status_of_system(error: OSError) -> Exit | None:
    if error.errno in _NO_ROOM:
        return Exit.STORAGE
    return Exit.BAD_INPUT if error.filename is not None and error.errno in _NO_SUCH_FILE else None
