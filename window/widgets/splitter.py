"""Parts beside or above each other, whose borders can be moved."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QSplitter, QWidget

_NARROW_LINES = 45
"""A screen that is less wide than so many lines are high."""


class Splitter(QSplitter):
    """Takes what room there is and asks for no more than its parts cannot do without."""

    def __init__(self, orientation: Qt.Orientation, parts: Sequence[QWidget], shares: Sequence[int]) -> None:
        super().__init__(orientation)
        self._across = orientation == Qt.Orientation.Horizontal
        for part, share in zip(parts, shares, strict=True):
            self.addWidget(part)
            self.setStretchFactor(self.count() - 1, share)
        self.setChildrenCollapsible(False)
        self.setSizes([1000 * share for share in shares])

    def fold(self, width: int) -> None:
        """Put what stands beside each other below each other where a screen is narrow for its text."""
        narrow = width < _NARROW_LINES * self.fontMetrics().height()
        if self._across:
            self.setOrientation(Qt.Orientation.Vertical if narrow else Qt.Orientation.Horizontal)

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As small as it can be."""
        return self.minimumSizeHint()
