"""The methods that are installed, and which of them reads a file.

A method is registered by an entry point of the group `tumble.methods`; the program names none of them.
"""

from collections.abc import Sequence
from functools import cache
from pathlib import Path

from tumble import plugins
from tumble.app.files import is_recording
from tumble.calibrations.core.bounded import check_bounded
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.known_tables import recognised
from tumble.calibrations.core.method import Method, Result
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.errors import RecordingError

GROUP = "tumble.methods"


@cache
def methods() -> tuple[Method, ...]:
    """All that are installed and can be used, by name. Raises `InputError` where the installation says none."""
    if not plugins.names(GROUP):
        raise InputError(
            Message("no method is installed: this installation is older than its files; install tumble again")
        )
    return tuple(plugins.usable(GROUP, Method).values())


@cache
def method_called(name: str) -> Method:
    """The method of this name, no other being loaded.

    Raises `LookupError` where none is installed, `InputError` where it cannot be used.
    """
    try:
        method: Method = plugins.load(GROUP, name, Method)
    except plugins.PluginError as error:
        raise InputError(str(error)) from error
    return method


def method_of(paths: Sequence[Path]) -> Method:
    """The method of tables and recordings, all of them of the same. Raises `InputError`."""
    first, *others = (_method(path) for path in paths)
    if any(other is not first for other in others):
        raise InputError(
            Message(
                "{first} and {second} are tables of different kinds; give them one by one",
                first=paths[0],
                second=paths[-1],
            )
        )
    return first


def close_loop(method: Method, paths: Sequence[Path]) -> Result:
    """Trace tables by a method. Raises `InputError`: unreadable or malformed."""
    try:
        return method.close_loop(paths)
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error


def _method(path: Path) -> Method:
    if is_recording(path):
        return _method_of_recording(path)
    try:
        check_bounded(path)
        return recognised(path, methods())
    except OSError as error:
        raise InputError(
            Message(
                "{path}: cannot be read ({reason}); check the name and the rights", path=path, reason=error.strerror
            )
        ) from error
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error


def _method_of_recording(path: Path) -> Method:
    from tumble.procedures.recording.reader import read_header  # MCAP only where there is a recording

    try:
        name = read_header(path).method
        return method_called(name)
    except RecordingError as error:
        raise InputError(str(error)) from error
    except LookupError as error:
        raise InputError(
            Message(
                "{path}: is of the method {method}, which this does not analyse; use its own command",
                path=path,
                method=name,
            )
        ) from error
