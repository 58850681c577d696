"""Two records held against each other, a row for each parameter."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from tumble.window.look.language import tr
from tumble.window.look.plain import as_tooltip
from tumble.window.widgets.interval_bars import INTERVALS, IntervalBars
from tumble.window.widgets.table import Table
from tumble.window.work.compared import Comparison

_BARS = 3
"""Column."""


class ComparisonTable(Table):
    """The values of both with bars on one axis, and the difference also in its standard uncertainties."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__([""] * 7, parent)
        self.setItemDelegateForColumn(_BARS, IntervalBars(self))

    def show_comparison(self, found: Comparison) -> None:
        """Show another comparison."""
        self.setHorizontalHeaderLabels(
            [
                tr("parameter"),
                f"● {found.first}",
                f"■ {found.second}",
                tr("95% intervals"),
                tr("difference ± U"),
                tr("in u"),
                tr("in words"),
            ]
        )
        self.fill(
            [
                (line.name, line.first, line.second, "", line.difference, line.ratio, line.conclusion)
                for line in found.lines
            ]
        )
        for row, line in enumerate(found.lines):
            bars = self.cell(row, _BARS)
            bars.setData(INTERVALS, line.intervals)
            for column in range(self.columnCount()):
                self.cell(row, column).setToolTip(as_tooltip(line.sentence))
            bars.setData(Qt.ItemDataRole.AccessibleTextRole, line.sentence)
