"""The parts that installed methods bring along for the window, by the entry point group `tumble.window`.

It names them by the names of the methods. A method that is not named there is shown by a `WindowPart` as it is.
"""

from functools import cache
from typing import Final

from tumble import plugins
from tumble.window.method import WindowPart

GROUP: Final = "tumble.window"


@cache
def window_part(method: str) -> WindowPart:
    """How a method is shown, by its name; as any other where its part cannot be used, which is logged."""
    try:
        part: WindowPart = plugins.load(GROUP, method, WindowPart)
    except LookupError:
        return WindowPart()
    except plugins.PluginError as error:
        plugins.warn_once(str(error))
        return WindowPart()
    return part
