"""Which method reads a table; one that none reads is refused by name, with what is there."""

import difflib
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Final, TypeVar

from tumble.calibrations.core.cells import TableError, column_shown, holds_numbers
from tumble.calibrations.core.files import read_header, read_lines
from tumble.calibrations.core.method import Method
from tumble.calibrations.core.sentences import series
from tumble.messages import Message
from tumble.plugins import warn_once

_Answer = TypeVar("_Answer", bool, str)

_FOREIGN: Final[tuple[tuple[str, tuple[str, ...]], ...]] = (
    (Message("a gyro"), ("rate_deg_s",)),
    (Message("Allan deviations"), ("tau_s",)),
)
"""Tables that have a name and are not analysed, by columns that show them."""
_SIGNALS: Final[tuple[tuple[str, tuple[str, ...]], ...]] = (
    (Message("Allan deviations"), ("adev", "oadev", "mdev", "hdev", "allan", "avar")),
    (Message("a gyro"), ("gyr_x", "omega_x", "gyro_x", "rate_x")),
    (Message("the climate of a room"), ("humidity", "rh_", "pressure", "dew")),
)
"""The same by parts of names."""
_NEAR: Final = 0.7
"""A name so like a known one is a slip of the pen."""


def recognised(path: Path, methods: Sequence[Method]) -> Method:
    """The method that reads a table, by its header.

    Raises
    ------
    TableError
        Unreadable, or a table of none of `methods`: what it looks like or what its columns are, and what is read.
    """
    if method := reader(methods, read_header(path)):
        return method
    header, lines = read_lines(path)  # a malformed table is refused as such
    numbers = [name for place, name in enumerate(header) if holds_numbers(place, lines)]
    if method := reader(methods, header):
        return method
    read = series([method.columns for method in methods], "or")
    if foreign := _foreign(header):
        raise TableError(
            Message(
                "{path}, line 1: this looks like a table of {foreign}, which this version does not analyse; "
                "tumble reads {read}",
                path=path,
                foreign=foreign,
                read=read,
            )
        )
    if method := reader(methods, header, numbers):
        return method
    nearest = sorted(methods, key=lambda method: _likeness(method, header), reverse=True)
    hints = (_answer(method, partial(method.hint, header, numbers), "") for method in nearest)
    hint = next(filter(None, hints), Message("not a table that tumble knows"))
    raise TableError(
        Message(
            "{path}, line 1: {hint}; the columns are {columns}; tumble reads {read}",
            path=path,
            hint=hint,
            columns=", ".join(map(column_shown, header)),
            read=read,
        )
    )


def reader(methods: Iterable[Method], header: Sequence[str], numbers: Sequence[str] | None = None) -> Method | None:
    """The first method that reads a table, see `Method.reads`; one that fails at it is passed by, with a warning."""
    return next((method for method in methods if _answer(method, partial(method.reads, header, numbers), False)), None)


def _likeness(method: Method, header: Sequence[str]) -> tuple[int, int]:
    """How many of the columns a method names as they are, and how many without their unit."""
    return sum(name in method.columns for name in header), sum(_bare(name) in method.columns for name in header)


def _bare(name: str) -> str:
    """A column's name without its unit."""
    return name.rpartition("_")[0] or name


def _unit(name: str) -> str:
    """The unit that a column's name ends with, in small letters; empty where it has none."""
    return name.rpartition("_")[2].lower() if "_" in name else ""


def _answer(method: Method, ask: Callable[[], _Answer], otherwise: _Answer) -> _Answer:
    """What a method says of a header, or `otherwise`: a stranger's package that fails stops no other."""
    try:
        return ask()
    except Exception as error:
        warn_once(
            Message(
                "the method {method} fails at the columns of a table ({kind}: {error}) and is left out; "
                "update or uninstall its package",
                method=method.name,
                kind=type(error).__name__,
                error=error,
            )
        )
        return otherwise


def misspelt(header: Sequence[str], known: Sequence[str], wanted: Sequence[str]) -> str:
    """What to ask where columns that are wanted are missing and others look like them; empty where none does.

    `known` are columns that are spelt right. Where one column alone is missing, another name is asked about that is
    the only one in its unit.
    """
    missing = [name for name in wanted if name not in header]
    lowered = {name.lower(): name for name in header if name not in known}
    close = {name: difflib.get_close_matches(name.lower(), lowered, n=1, cutoff=_NEAR) for name in missing}
    if len(missing) == 1 < len(wanted):
        close[missing[0]] = close[missing[0]] or _in_the_unit_of(missing[0].lower(), lowered)
    near = {lowered[names[0]]: name for name, names in close.items() if names}
    if not near:
        return ""
    asked = series([f"{column_shown(given)} {name}" for given, name in near.items()])
    return Message("column {name} is missing; is {asked}? Rename and check the unit", name=missing[0], asked=asked)


def _in_the_unit_of(name: str, others: Iterable[str]) -> list[str]:
    """The other name in the unit of `name`, all in small letters; empty where there is none, or more than one."""
    alike = [other for other in others if _unit(other) and _unit(other) == _unit(name)]
    return alike if len(alike) == 1 else []


def _foreign(header: Sequence[str]) -> str:
    """What a table of another kind is of; empty where nothing shows it."""
    for what, columns in _FOREIGN:
        if all(column in header for column in columns):
            return Message("{what} ({columns})", what=what, columns=series(columns))
    for what, parts in _SIGNALS:
        if shown := [name for name in header if any(name.lower().startswith(part) for part in parts)]:
            return Message("{what} ({columns})", what=what, columns=series(shown))
    return ""
