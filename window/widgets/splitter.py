"""Parts beside or above each other, whose borders can be moved."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QSplitter, QWidget


class Splitter(QSplitter):
    """Takes what room there is and asks for no more than its parts cannot do without."""

    def __init__(self, orientation: Qt.Orientation, parts: Sequence[QWidget], shares: Sequence[int]) -> None:
        super().__init__(orientation)
        for part, share in zip(parts, shares, strict=True):
            self.addWidget(part)
            self.setStretchFactor(self.count() - 1, share)
        self.setChildrenCollapsible(False)
        self.setSizes([1000 * share for share in shares])

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As small as it can be."""
        return self.minimumSizeHint()
