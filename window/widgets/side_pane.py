"""A pane beside other parts, which is one of their tabs where there is no room for it."""

from PySide6.QtCore import QEvent
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QTabWidget, QWidget

_WIDE_LINES = 90
"""From so many lines of text on a screen is wide enough for a pane at its side."""


class SidePane(QWidget):
    """The main part, and a pane at its right; where that is narrow, the pane is the last of the main part's tabs."""

    def __init__(self, main: QWidget, tabs: QTabWidget, pane: QWidget, title: str) -> None:
        super().__init__()
        self._tabs, self._pane, self._title = tabs, pane, title
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.addWidget(main, stretch=3)
        tabs.addTab(pane, title)

    @property
    def is_folded(self) -> bool:
        """Whether the pane is a tab."""
        return self._tabs.indexOf(self._pane) >= 0

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Fold, or unfold."""
        super().resizeEvent(event)
        self._fold()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """The same for another size of text."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fold()

    def _fold(self) -> None:
        narrow = self.width() < _WIDE_LINES * self.fontMetrics().height()
        if narrow and not self.is_folded:
            self._row.removeWidget(self._pane)
            self._tabs.addTab(self._pane, self._title)
        elif not narrow and self.is_folded:
            self._tabs.removeTab(self._tabs.indexOf(self._pane))
            self._row.addWidget(self._pane, stretch=1)
            self._pane.show()
