"""Whether Qt can open a window here, found out before it is asked to: it would end the process."""

import ctypes
import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Final

DEBIAN: Final = (
    "libglib2.0-0 libegl1 libgl1 libdbus-1-3 libfontconfig1 libxkbcommon0 "
    "libxcb-cursor0 libxcb-icccm4 libxcb-keysyms1 libxcb-shape0 libxcb-xkb1 libxkbcommon-x11-0"
)
"""Packages that a bare Debian or Ubuntu lacks; the second half for a window on a screen."""


def obstacle() -> str:
    """Why there can be no window, and what to do; empty where there can."""
    if find_spec("PySide6") is None or find_spec("pyqtgraph") is None:
        return "the window needs PySide6-Essentials and pyqtgraph, which are not installed; run make setup"
    try:
        import PySide6.QtWidgets  # noqa: F401  # its libraries are loaded now or not at all
    except ImportError as error:
        return _lacking(str(error))
    return _screen_obstacle() if sys.platform == "linux" else ""


def _screen_obstacle() -> str:
    """Qt aborts where its plugin for the screen cannot be loaded, and where there is no screen."""
    platform = os.environ.get("QT_QPA_PLATFORM", "")
    if platform and not platform.startswith("xcb"):
        return ""
    if os.environ.get("WAYLAND_DISPLAY") and not platform:
        return ""
    if not os.environ.get("DISPLAY"):
        return "there is no screen here (neither DISPLAY nor WAYLAND_DISPLAY is set); start it on a desktop"
    try:
        ctypes.CDLL(str(_plugin()))
    except OSError as error:
        return _lacking(str(error))
    return ""


def _plugin() -> Path:
    import PySide6

    return Path(PySide6.__file__).parent / "Qt" / "plugins" / "platforms" / "libqxcb.so"


def _lacking(what: str) -> str:
    return f"a library that the window needs is missing ({what}); on Debian or Ubuntu: apt-get install {DEBIAN}"
