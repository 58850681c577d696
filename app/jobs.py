"""The methods whose units are measured at a stand of this program: their jobs, by the entry point group `tumble.jobs`.

A recording says its method, and a table is known by its columns.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble import plugins
from tumble.app.files import is_recording
from tumble.app.methods import method_called
from tumble.calibrations.core.files import read_header
from tumble.calibrations.core.known_tables import reader
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.first_method import FIRST

if TYPE_CHECKING:
    from tumble.app.job_part import JobPart

GROUP: Final = "tumble.jobs"


def has_job(method: str) -> bool:
    """Whether a method is measured at a stand of this program: its files may be recordings, and its loop acts."""
    return method in plugins.names(GROUP)


def measured_at_stand(method: str, paths: Sequence[Path]) -> bool:
    """Whether files of a method are runs at a stand, or tables as such runs leave them. Raises `InputError`."""
    if not has_job(method):
        return False
    from tumble.app.job_part import SomeTables

    part = find_job(method)
    if not isinstance(part, SomeTables):
        return True
    return all(is_recording(path) or part.reads(read_header(path)) for path in paths)


def find_job(method: str) -> "JobPart":
    """What a method brings to the job. Raises `InputError` where none is installed or usable, see `has_job`."""
    from tumble.app.job_part import JobPart

    try:
        part: JobPart = plugins.load(GROUP, method, JobPart)
    except plugins.PluginError as error:
        raise InputError(str(error)) from error
    except LookupError:
        raise InputError(
            Message(
                "the method {method} can be run, but no analysis of its recordings is installed; use tumble run",
                method=method,
            )
        ) from None
    return part


def job_names() -> list[str]:
    """Names of all methods that are measured at a stand, the first of all at the beginning. Raises `InputError`."""
    known = plugins.names(GROUP)
    if not known:
        raise InputError(
            Message("no job of a method is installed: this installation is older than its files; install tumble again")
        )
    return sorted(known, key=lambda name: (name != FIRST, name))


def method_of_table(path: Path) -> str:
    """The method whose unit a table is of; of a table of none of them that which can say what is wrong with it."""
    first, *others = names = job_names()
    if not others:
        return first
    known, header = [method_called(name) for name in names], read_header(path)
    if method := reader(known, header):
        return method.name
    return next((method.name for method in known if method.hint(header, ())), first)
