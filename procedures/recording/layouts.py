"""The columns of a recording, by the method that its header names."""

from pathlib import Path

from tumble.messages import Message
from tumble.procedures.layout import Layout
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.header import Header
from tumble.procedures.registry import find_method


def layout_of(path: Path, header: Header) -> Layout:
    """The columns of the points in a recording.

    Raises
    ------
    RecordingError
        The method is not installed, or only an older version of it.
    """
    try:
        method = find_method(header.method)
    except ValueError as error:
        raise RecordingError(
            path, Message("is of a method that is not installed here ({error})", error=error), Message("install it")
        ) from error
    if header.method_version > method.version:
        happened = Message(
            "is of version {method_version} of {method}, and {version} is installed",
            method_version=header.method_version,
            method=header.method,
            version=method.version,
        )
        raise RecordingError(
            path,
            happened,
            Message("read it with tumble {program_version} or newer", program_version=header.program_version),
        )
    return method.procedure_part.layout
