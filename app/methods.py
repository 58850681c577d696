"""The methods that are installed, and which of them reads a file.

A method is registered by an entry point of the group `tumble.methods`; the program names none of them.
"""

from collections.abc import Sequence
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path

from tumble.app.files import is_recording
from tumble.calibrations.core.bounded import check_bounded
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.known_tables import recognised
from tumble.calibrations.core.method import Method, Result
from tumble.procedures.errors import InputError

GROUP = "tumble.methods"


@cache
def methods() -> tuple[Method, ...]:
    """All that are installed, by name. Raises `InputError` where the installation says none."""
    points = sorted(entry_points(group=GROUP), key=lambda point: point.name)
    if not points:
        raise InputError("no method is installed: this installation is older than its files; install tumble again")
    return tuple(point.load() for point in points)


def method_of(paths: Sequence[Path]) -> Method:
    """The method of tables and recordings, all of them of the same. Raises `InputError`."""
    first, *others = (_method(path) for path in paths)
    if any(other is not first for other in others):
        raise InputError(f"{paths[0]} and {paths[-1]} are tables of different kinds; give them one by one")
    return first


def close_loop(method: Method, paths: Sequence[Path]) -> Result:
    """Trace tables by a method. Raises `InputError`: unreadable or malformed."""
    try:
        return method.close_loop(paths)
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error


def _method(path: Path) -> Method:
    if is_recording(path):
        return next(method for method in methods() if method.at_stand)
    try:
        check_bounded(path)
        return recognised(path, methods())
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the name and the rights") from error
    except (TableError, ValueError) as error:
        raise InputError(str(error)) from error
