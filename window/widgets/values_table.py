"""The values to use: each with its uncertainty, against its limits, and since the last calibration."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final, TypeAlias

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRectF, QSize, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import (
    QCheckBox,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from tumble.messages import Message
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.look.theme import colours
from tumble.window.widgets.limit_bar import draw_bar
from tumble.window.widgets.table import Ink, Table
from tumble.window.work.presentation import ParameterLine

_Index: TypeAlias = QModelIndex | QPersistentModelIndex
_BAR: Final = Qt.ItemDataRole.UserRole + 8
_LONG: Final = 6
"""Length of a bar in heights of a line."""
_GAP_PX: Final = 6
"""Between a bar and the text after it."""
_COLUMNS: Final[dict[str, Callable[[ParameterLine], str]]] = {
    Message("parameter"): lambda line: line.name,
    Message("quantity"): lambda line: line.words,
    Message("Value ± U"): lambda line: line.value or Message("not identifiable"),
    Message("limits"): lambda line: line.limits,
    Message("verdict"): lambda line: line.verdict,
    Message("change"): lambda line: line.change,
    Message("95% interval"): lambda line: line.interval,
    Message("standard uncertainty"): lambda line: line.standard,
    Message("declared model"): lambda line: line.declared,
    Message("condition"): lambda line: line.note,
}
_HEADINGS: Final = list(_COLUMNS)
_LIMITS: Final = _HEADINGS.index("limits")
"""Where the bar stands before the limits."""
_FURTHER: Final = {_HEADINGS.index(each) for each in ("95% interval", "standard uncertainty", "declared model")}
"""What is shown on request."""
_CHANGE: Final = _HEADINGS.index("change")


class ValuesTable(QWidget):
    """A line for each parameter, with a bar where it has limits; a column in which nothing would stand is left out."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.table = Table([in_language(heading) for heading in _HEADINGS])
        self.table.setItemDelegateForColumn(_LIMITS, _BarDelegate(self.table))
        self.table.setSizeAdjustPolicy(QTableWidget.SizeAdjustPolicy.AdjustToContents)
        self.reasons = PlainLabel()
        self.reasons.setWordWrap(True)
        self.further = QCheckBox(tr("&Intervals, standard uncertainties, declared model"))
        self.further.toggled.connect(self._show_columns)
        further = self.table.offer(self.further.text(), self.further.toggle)
        further.setCheckable(True)
        self.further.toggled.connect(further.setChecked)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.table, stretch=1)
        column.addWidget(self.reasons)
        column.addWidget(self.further)

    def show_lines(self, lines: Sequence[ParameterLine]) -> None:
        """Show other values."""
        days = sorted({line.since for line in lines if line.change})
        dated = lines if len(days) < 2 else list(map(_with_day, lines))
        unsettled: list[Ink | None] = [None if line.outcome.good else "bad" for line in lines]
        self.table.fill([[in_language(cell(line)) for cell in _COLUMNS.values()] for line in dated], unsettled)
        self._name_change(days)
        for number, line in enumerate(lines):
            item = self.table.item(number, _LIMITS)
            if item is not None:
                item.setData(_BAR, line.bar)
        self._tell_reasons([line for line in lines if line.reason])
        self._show_columns()

    def _name_change(self, days: Sequence[str]) -> None:
        """The day of the last calibration stands once above the changes, where it is that of all."""
        heading = tr("change since {date}", date=days[0]) if len(days) == 1 else tr("change")
        self.table.setHorizontalHeaderItem(_CHANGE, QTableWidgetItem(heading))

    def _tell_reasons(self, lines: Sequence[ParameterLine]) -> None:
        told = [
            tr("{name} is not identifiable: {reason}", name=line.name, reason=in_language(line.reason))
            for line in lines
        ]
        self.reasons.setText("\n".join(told))
        self.reasons.setVisible(bool(told))

    def texts(self) -> list[list[str]]:
        """What the cells of all columns say."""
        return self.table.texts()

    def _show_columns(self) -> None:
        texts = self.texts()
        for column in range(self.table.columnCount()):
            asked = self.further.isChecked() or column not in _FURTHER
            self.table.setColumnHidden(column, not (asked and any(row[column] for row in texts)))


def _with_day(line: ParameterLine) -> ParameterLine:
    if not line.change:
        return line
    return replace(line, change=tr("{change} since {date}", change=line.change, date=line.since))


class _BarDelegate(QStyledItemDelegate):
    """Draws the bar of a cell in the place of its icon, before its text."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: _Index) -> None:  # noqa: N802  # Qt's name
        """Leave room for the bar."""
        super().initStyleOption(option, index)
        if index.data(_BAR) is not None:
            line = option.fontMetrics.height()
            option.features |= QStyleOptionViewItem.ViewItemFeature.HasDecoration
            option.decorationSize = QSize(_LONG * line, line)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        """Draw the cell, and the bar over it."""
        super().paint(painter, option, index)
        if (bar := index.data(_BAR)) is None:
            return
        filled = QStyleOptionViewItem(option)
        self.initStyleOption(filled, index)
        table = filled.widget
        place = table.style().subElementRect(QStyle.SubElement.SE_ItemViewItemDecoration, filled, table)
        ink = colours(table).highlighted if filled.state & QStyle.StateFlag.State_Selected else ""
        draw_bar(painter, QRectF(place.adjusted(0, 0, -_GAP_PX, 0)), bar, colours(table), ink=ink)
