"""The methods that can be run at a stand, by the entry point group `tumble.procedures`."""

import sys
from collections.abc import Mapping
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import TYPE_CHECKING, Final

from tumble.messages import Message

if TYPE_CHECKING:
    from tumble.procedures.method import Method

FIRST: Final = "dividing_head"
"""The method of programmes and recordings that name none: version 0.1 knew no other."""
_GROUP: Final = "tumble.procedures"


def find_method(name: str) -> "Method":
    """An installed method by its name. Raises `ValueError` where there is none, with the names of those that are."""
    known = _named(tuple(sys.path))
    if name not in known:
        raise ValueError(
            Message(
                "no method is called {name!r}; known are {known}",
                name=name,
                known=", ".join(sorted(known)) or Message("none"),
            )
        )
    method: Method = known[name].load()
    return method


def method_names() -> list[str]:
    """Names of all installed methods, the first of all at the beginning."""
    return sorted(_named(tuple(sys.path)), key=lambda name: (name != FIRST, name))


@lru_cache(maxsize=8)
def _named(_: tuple[str, ...]) -> Mapping[str, EntryPoint]:
    """What installed packages name, looked up once for each place where packages lie: it takes 20 ms."""
    return {entry.name: entry for entry in entry_points(group=_GROUP)}
