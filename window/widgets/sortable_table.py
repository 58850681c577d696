"""A table whose rows are put into order by any of its columns."""

import re
from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QTableWidgetItem, QWidget

from tumble.window.widgets.table import Ink, Table

_NUMBER: Final = re.compile(r"([-−]?\d+(?:[.,]\d+)?)")
_ROW: Final = Qt.ItemDataRole.UserRole


class _Item(QTableWidgetItem):
    """Comes before another by the numbers in what it is sorted by, and by the row that it had where these are alike."""

    def __init__(self, text: str, row: int, sorted_by: str) -> None:
        super().__init__(text)
        self.setData(_ROW, row)
        self.place = _parts(sorted_by), row

    def __lt__(self, other: QTableWidgetItem) -> bool:
        assert isinstance(other, _Item), "all cells of a table are of this kind"
        return self.place < other.place


class SortableTable(Table):
    """A click on a heading sorts by it, at first by the column `newest`, the last on top.

    Rows go by the numbers that they had when they were filled in, wherever they stand.
    """

    def __init__(self, headings: Sequence[str], newest: int, parent: QWidget | None = None) -> None:
        super().__init__(headings, parent)
        self.setSortingEnabled(True)
        self.sortByColumn(newest, Qt.SortOrder.DescendingOrder)

    def write(self, rows: Sequence[Sequence[str]], inks: Sequence[Ink | None]) -> None:
        """Put other texts into the cells, in the order that is chosen."""
        self.setSortingEnabled(False)
        super().write(rows, inks)
        self.setSortingEnabled(True)

    def number(self, row: int) -> int:
        """The number that a row had when it was filled in, by where it stands now."""
        return int(self.model().index(row, 0).data(_ROW))

    @property
    def chosen(self) -> list[int]:
        """Numbers of the rows that are selected, as they were filled in, the lowest first."""
        return sorted(self.number(row) for row in super().chosen)

    def item_made(self, text: str, row: int, column: int) -> QTableWidgetItem:
        """A cell that knows its order."""
        return _Item(text, row, self.sorted_by(text, row, column))

    def sorted_by(self, text: str, row: int, column: int) -> str:  # noqa: ARG002  # for texts that do not sort
        """What puts a cell into order: numbers in it count by their size."""
        return text


def _parts(text: str) -> list[tuple[int, float, str]]:
    """Text and numbers in turn, each comparable with any other."""
    found = _NUMBER.split(text.casefold())
    return [
        (0, float(part.replace(",", ".").replace("−", "-")), "") if place % 2 else (1, 0.0, part)
        for place, part in enumerate(found)
        if part
    ]
