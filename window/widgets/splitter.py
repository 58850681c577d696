"""Parts beside or above each other, whose borders can be moved."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QSplitter, QWidget

NARROW_LINES = 45
"""A screen that is less wide than so many lines are high."""


class Splitter(QSplitter):
    """Takes what room there is and asks for no more than its parts cannot do without."""

    def __init__(self, orientation: Qt.Orientation, parts: Sequence[QWidget], shares: Sequence[int]) -> None:
        super().__init__(orientation)
        self._shares = tuple(shares)
        self._across = orientation == Qt.Orientation.Horizontal
        for part in parts:
            self.addWidget(part)
        self.setChildrenCollapsible(False)
        self._share_out()

    def replace(self, before: QWidget, after: QWidget) -> None:
        """Put another part in the place of one, which is deleted; the borders are where they were at the beginning."""
        self.replaceWidget(self.indexOf(before), after)
        before.hide()  # it is deleted when the event loop comes to it
        before.deleteLater()
        self._share_out()

    def fold(self, width: int) -> None:
        """Put what stands beside each other below each other where a screen is narrow for its text."""
        narrow = width < NARROW_LINES * self.fontMetrics().height()
        if self._across:
            self.setOrientation(Qt.Orientation.Vertical if narrow else Qt.Orientation.Horizontal)

    def _share_out(self) -> None:
        for place, share in enumerate(self._shares):
            self.setStretchFactor(place, share)
        self.setSizes([1000 * share for share in self._shares])

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As small as it can be."""
        return self.minimumSizeHint()
