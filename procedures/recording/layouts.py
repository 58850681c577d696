"""The columns of a recording, by the method that its header names."""

from pathlib import Path

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
        raise RecordingError(path, f"is of a method that is not installed here ({error})", "install it") from error
    if header.method_version > method.version:
        happened = f"is of version {header.method_version} of {header.method}, and {method.version} is installed"
        raise RecordingError(path, happened, f"read it with tumble {header.program_version} or newer")
    return method.procedure_part.layout
