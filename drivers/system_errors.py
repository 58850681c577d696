"""What the operating system says of an error, as messages."""

from typing import Final

from tumble.messages import Message, translatable

_REASONS: Final = frozenset(
    (
        translatable("Broken pipe"),
        translatable("Connection refused"),
        translatable("Connection reset by peer"),
        translatable("Connection timed out"),
        translatable("Device or resource busy"),
        translatable("Disk quota exceeded"),
        translatable("File exists"),
        translatable("File name too long"),
        translatable("File too large"),
        translatable("Input/output error"),
        translatable("Invalid argument"),
        translatable("Is a directory"),
        translatable("Name or service not known"),
        translatable("Network is unreachable"),
        translatable("No route to host"),
        translatable("No space left on device"),
        translatable("No such device"),
        translatable("No such file or directory"),
        translatable("Not a directory"),
        translatable("Operation not permitted"),
        translatable("Permission denied"),
        translatable("Read-only file system"),
        translatable("Too many levels of symbolic links"),
        translatable("timed out"),
    )
)
"""What the C library of Linux says; Windows says it otherwise, and in the language of the desktop."""


def reason_of_system(error: OSError) -> str:
    """Why the system could not do something: a message where it is a common reason, else the words of the system."""
    reason = str(error.strerror or error)
    return Message.marked(reason) if reason in _REASONS else reason
