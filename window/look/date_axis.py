"""An axis of time."""

from collections.abc import Mapping
from math import floor
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import QDateTime, QLocale

_WORDS: Final[Mapping[str, str]] = {"%a %d": "ddd dd", "%b": "MMM"}
"""Formats of pyqtgraph's ticks that write words, as Qt writes them."""


class DateAxis(pg.DateAxisItem):  # type: ignore[misc]  # pyqtgraph is not typed
    """Days and months in the language of the window; pyqtgraph writes them in that of the process."""

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:  # noqa: N802  # its name
        """What stands beside the ticks."""
        specs = self.zoomLevel.tickSpecs
        written = next((_WORDS[each.format] for each in specs if each.spacing == spacing and each.format in _WORDS), "")
        if not written:
            texts: list[str] = super().tickStrings(values, scale, spacing)
            return texts
        moments = (QDateTime.fromSecsSinceEpoch(floor(value)) for value in values)
        return [QLocale().toString(moment, written) for moment in moments]
