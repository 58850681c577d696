"""The parts that installed methods bring along for the window, by the entry point group `tumble.window`.

It names them by the names of the methods. A method that is not named there is shown by a `WindowPart` as it is.
"""

from functools import cache
from importlib.metadata import entry_points
from typing import Final

from tumble.window.method import WindowPart

GROUP: Final = "tumble.window"


@cache
def window_part(method: str) -> WindowPart:
    """How a method is shown, by its name."""
    for entry in entry_points(group=GROUP, name=method):
        part: WindowPart = entry.load()
        return part
    return WindowPart()
