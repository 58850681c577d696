"""A plot as something that can be saved, and the wish to do so, which reaches the window from wherever the plot is."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication

from tumble.window.plots.values import Values

_SAVE_WANTED: Final = QEvent.Type(QEvent.registerEventType())


@dataclass(frozen=True, kw_only=True)
class Savable:
    """What goes into a file."""

    name: str
    """Of the file, without its ending."""
    plot: pg.PlotWidget
    values: Callable[[], Values]


class SaveWanted(QEvent):
    """Sent to the window of a plot that is to be saved."""

    def __init__(self, savable: Savable) -> None:
        super().__init__(_SAVE_WANTED)
        self.savable = savable


def ask_to_save(savable: Savable) -> None:
    """Have the window of a plot ask for a file, and write it."""
    QApplication.sendEvent(savable.plot.window(), SaveWanted(savable))
