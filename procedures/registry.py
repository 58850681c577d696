"""The methods that can be run at a stand, by the entry point group `tumble.procedures`."""

from typing import TYPE_CHECKING, Final

from tumble import plugins
from tumble.messages import Message
from tumble.procedures.first_method import FIRST

if TYPE_CHECKING:
    from tumble.procedures.method import Method

_GROUP: Final = "tumble.procedures"


def find_method(name: str) -> "Method":
    """An installed method by its name.

    Raises `ValueError` where there is none, with the names of those that are, and where it cannot be used.
    """
    from tumble.procedures.method import Method

    try:
        method: Method = plugins.load(_GROUP, name, Method)
    except LookupError:
        known = ", ".join(plugins.names(_GROUP)) or Message("none")
        raise ValueError(Message("no method is called {name!r}; known are {known}", name=name, known=known)) from None
    return method


def usable_methods() -> list["Method"]:
    """All installed methods that can be used, the first of all at the beginning."""
    from tumble.procedures.method import Method

    found = plugins.usable(_GROUP, Method)
    return [found[name] for name in sorted(found, key=lambda name: (name != FIRST, name))]
