"""The methods whose units are measured at a stand of this program: their jobs, by the entry point group `tumble.jobs`.

A recording says its method, and a table is known by its columns.
"""

import sys
from collections.abc import Mapping
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.app.methods import method_called
from tumble.calibrations.core.files import read_header
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.registry import FIRST

if TYPE_CHECKING:
    from tumble.app.job_part import JobPart

GROUP: Final = "tumble.jobs"


def has_job(method: str) -> bool:
    """Whether a method is measured at a stand of this program: its files may be recordings, and its loop acts."""
    return method in _named(tuple(sys.path))


def find_job(method: str) -> "JobPart":
    """What a method brings to the job. Raises `InputError` where none is installed, see `has_job`."""
    known = _named(tuple(sys.path))
    if method not in known:
        raise InputError(
            Message(
                "the method {method} can be run, but no analysis of its recordings is installed; use tumble run",
                method=method,
            )
        )
    part: JobPart = known[method].load()
    return part


def job_names() -> list[str]:
    """Names of all methods that are measured at a stand, the first of all at the beginning. Raises `InputError`."""
    known = _named(tuple(sys.path))
    if not known:
        raise InputError(
            Message("no job of a method is installed: this installation is older than its files; install tumble again")
        )
    return sorted(known, key=lambda name: (name != FIRST, name))


def method_of_table(path: Path) -> str:
    """The method whose unit a table is of; of a table of none of them the first, which says what is wrong with it."""
    first, *others = names = job_names()
    if not others:
        return first
    header = read_header(path)
    return next((name for name in names if method_called(name).reads(header, None)), first)


@lru_cache(maxsize=8)
def _named(_: tuple[str, ...]) -> Mapping[str, EntryPoint]:
    """What installed packages name, looked up once for each place where packages lie."""
    return {entry.name: entry for entry in entry_points(group=GROUP)}
