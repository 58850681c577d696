"""What a method may bring along for the window, one kind of widget for each place."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from PySide6.QtWidgets import QWidget

from tumble.procedures.steps import Dwell, Point
from tumble.window.look.plots import Plot
from tumble.window.work.presentation import Presentation

_TIMES_FITTED: Final = 2
"""Marks say how large they are once the axes are fitted, and an axis that follows another one may come before it."""


class Overview(QWidget):
    """Where a run is in its programme."""

    @property
    def done(self) -> int:
        """Number of dwells that are done."""
        raise NotImplementedError

    def show_plan(self, dwells: Sequence[Dwell], points: Sequence[Point] = ()) -> None:
        """Show a programme, and the points of its first dwells where these are done."""
        raise NotImplementedError

    def begin(self, dwell: Dwell) -> None:
        """Mark a dwell as the one that is taken now."""
        raise NotImplementedError

    def complete(self, dwell: Dwell, point: Point) -> None:
        """Mark a dwell as done, with the point that came of it."""
        raise NotImplementedError


class Figures(QWidget):
    """Plots of the points of a run while it goes on.

    They are drawn anew one at a time: all at once would be felt.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._stale: dict[Callable[[], None], None] = {}
        """What is to be drawn anew, in order."""

    def begin(self, points: Sequence[Point]) -> None:
        """Show a run that begins, or goes on after some points."""
        raise NotImplementedError

    def expect(self, dwells: Sequence[Dwell]) -> None:
        """Make room for what a run is going to measure; called before `begin`, and may do nothing."""

    def add(self, point: Point) -> None:
        """Show a further point."""
        raise NotImplementedError

    def analyse(self) -> None:
        """Begin to analyse the points so far; called a few times a second, and may do nothing."""

    def draw_later(self, *draw: Callable[[], None]) -> None:
        """Have something drawn by the calls of `draw_next` that follow."""
        self._stale |= dict.fromkeys(draw)

    def draw_next(self) -> bool:
        """Draw one of the plots that are not up to date; false where all are."""
        if not self._stale:
            return False
        draw = next(iter(self._stale))
        del self._stale[draw]
        draw()
        for plot in _TIMES_FITTED * self.findChildren(Plot):
            plot.fit_axes()
        return True


@dataclass(frozen=True, kw_only=True)
class ResultTab:
    """A tab of the screen Result."""

    title: str
    widget: QWidget
    show: Callable[[Presentation], None]
    """Has it show another result."""
