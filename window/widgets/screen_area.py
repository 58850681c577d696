"""The place of a screen: it fills the place, and is scrolled where it cannot be made as small as that."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QScrollArea, QWidget

from tumble.window.widgets.splitter import Splitter


class ScreenArea(QScrollArea):
    """Unlike a resizable `QScrollArea` it scrolls by what a screen needs, not by what it would like to have."""

    def __init__(self, screen: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QScrollArea.Shape.NoFrame)
        self._screen = screen
        self.setWidget(screen)
        screen.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Fit the screen anew when its parts have changed."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._fit()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Fit the screen to another place."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        screen, room = self._screen, self.maximumViewportSize()
        layout = screen.layout()
        if layout is None:
            return
        for splitter in screen.findChildren(Splitter):
            splitter.fold(room.width())
        least = layout.minimumSize()
        wide = max(room.width(), least.width())
        high = layout.minimumHeightForWidth(wide) if layout.hasHeightForWidth() else least.height()
        if high > room.height():  # the bar beside it takes room
            wide = max(wide - self.verticalScrollBar().sizeHint().width(), least.width())
            high = layout.minimumHeightForWidth(wide) if layout.hasHeightForWidth() else least.height()
        screen.resize(wide, max(room.height(), high))
        scrolls = high > room.height() or wide > room.width()  # by its own keys, where it does at all
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus if scrolls else Qt.FocusPolicy.NoFocus)
