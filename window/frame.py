"""What stands around the screens, and what lies over them."""

from collections.abc import Callable, Iterator, Sequence
from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QApplication, QHBoxLayout, QStackedWidget, QVBoxLayout, QWidget

from tumble.window.finder.finder import Finder
from tumble.window.widgets.dialog import Dialogs
from tumble.window.widgets.notice import Notices
from tumble.window.widgets.rail import Place, Rail
from tumble.window.widgets.screen_area import ScreenArea
from tumble.window.widgets.stop_bar import StopBar
from tumble.window.widgets.top_strip import TopStrip

_GAPS_PX: Final = 24
"""Between the parts, together."""


class Frame(QWidget):
    """Strip, rail and screens, dialogs, STOP; notices and the finder lie over the screens, and over nothing else.

    Parameters
    ----------
    places, screens
        The same number of both, in the same order.
    above
        Height of what the window has above the frame, in pixels.
    """

    def __init__(self, places: Sequence[Place], screens: Sequence[QWidget], above: Callable[[], int]) -> None:
        super().__init__()
        self._above = above
        self.places, self.screens = tuple(places), tuple(screens)
        self.strip, self.rail, self.stop_bar = TopStrip(), Rail(places), StopBar()
        self.dialogs, self._middle, self._stack = Dialogs(self._room), QWidget(), QStackedWidget()
        self._lay_out()
        self.notices, self.finder = Notices(self._middle), Finder(self._middle)
        self.rail.chosen.connect(self._show)

    @property
    def current(self) -> QWidget:
        """The screen that is shown."""
        return self.screens[self.rail.current]

    def open(self, screen: QWidget) -> None:
        """Show one of the screens."""
        self.rail.choose(self.screens.index(screen))

    def close_newest(self) -> bool:
        """Close what lies over the screens, or the dialog, or the newest notice; false where there is none."""
        return self.finder.close_it() or self.dialogs.close_newest() or self.notices.close_newest()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Have the rail take what room there is now."""
        super().resizeEvent(event)
        self.rail.fold()

    def _show(self, number: int) -> None:
        """Show a screen, and give the keyboard to the part that had it last, or to its first."""
        self._stack.setCurrentIndex(number)
        screen, here = self.screens[number], QApplication.focusWidget()
        if here is None or not screen.isAncestorOf(here):
            wanted = next(_in_order_of_tabs(screen), None)
            if wanted is not None:
                wanted.setFocus(Qt.FocusReason.OtherFocusReason)

    def _room(self) -> int:
        """What everything else leaves of the height for dialogs."""
        kept = sum(part.minimumSizeHint().height() for part in (self.rail, self.stop_bar))
        strip = max(self.strip.height(), self.strip.minimumSizeHint().height())
        return max(self.window().height() - kept - strip - self._above() - _GAPS_PX, 0)

    def _lay_out(self) -> None:
        for screen in self.screens:
            self._stack.addWidget(ScreenArea(screen))
        across = QHBoxLayout(self._middle)
        across.setContentsMargins(0, 0, 0, 0)
        across.addWidget(self.rail)
        across.addWidget(self._stack, stretch=1)
        down = QVBoxLayout(self)
        down.setContentsMargins(0, 0, 0, 0)
        down.addWidget(self.strip)
        down.addWidget(self._middle, stretch=1)
        down.addWidget(self.dialogs)
        down.addWidget(self.stop_bar)


def _in_order_of_tabs(screen: QWidget) -> Iterator[QWidget]:
    """What Tab reaches on a screen, the part that had the keyboard last before all others.

    By the children, which were put there in this order, and not by `nextInFocusChain`: PySide takes what that returns
    for a child of what was asked, and forgets the menus once any of these is deleted.
    """
    last = screen.focusWidget()
    for part in ([last] if last is not None else []) + screen.findChildren(QWidget):
        if part.focusPolicy() & Qt.FocusPolicy.TabFocus and part.isVisible() and part.isEnabled():
            yield part
