"""Values with their intervals in a cell of a table, one below the other on an axis of their own."""

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QLineF, QModelIndex, QPersistentModelIndex, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from tumble.window.look.theme import colours
from tumble.window.work.compared import Interval

INTERVALS: Final = Qt.ItemDataRole.UserRole + 8
"""A sequence of `Interval` or None."""
_MARGIN_PX: Final = 6.0
_LINE_PX: Final = 2.0
_WIDE_LINES, _HIGH_LINES = 7, 1.9


class IntervalBars(QStyledItemDelegate):
    """Draws the first with a circle, the second with a square, in the first two colours of data."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:  # noqa: N802, ARG002  # Qt's name
        """Some lines of text wide, and as high as two lanes need."""
        line = option.fontMetrics.height()
        return QSize(_WIDE_LINES * line, round(_HIGH_LINES * line))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Draw the ground of the cell, and the intervals on it."""
        super().paint(painter, option, index)
        intervals: Sequence[Interval | None] = index.data(INTERVALS) or ()
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        inks = _inks(option.widget, chosen=chosen)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for place, lane in enumerate(_lanes(intervals, QRectF(option.rect))):
            if lane is not None:
                _draw(painter, lane, inks[place % len(inks)], square=bool(place % 2))
        painter.restore()


def _inks(widget: QWidget, *, chosen: bool) -> tuple[str, ...]:
    shades = colours(widget)
    return (shades.highlighted,) if chosen else shades.data[:2]


def _lanes(intervals: Sequence[Interval | None], cell: QRectF) -> list[tuple[QLineF, QPointF] | None]:
    """The bar of each interval and the place of its value, on an axis that holds all of them."""
    there = [each for each in intervals if each is not None]
    if not there:
        return []
    low, high = min(each.low for each in there), max(each.high for each in there)
    scale = (cell.width() - 2 * _MARGIN_PX) / (high - low) if high > low else 0.0

    def x(value: float) -> float:
        return cell.left() + _MARGIN_PX + (value - low) * scale if scale else cell.center().x()

    heights = [cell.top() + cell.height() * (place + 0.5) / len(intervals) for place in range(len(intervals))]
    return [
        None if each is None else (QLineF(x(each.low), y, x(each.high), y), QPointF(x(each.value), y))
        for each, y in zip(intervals, heights, strict=True)
    ]


def _draw(painter: QPainter, lane: tuple[QLineF, QPointF], ink: str, *, square: bool) -> None:
    bar, value = lane
    painter.setPen(QPen(QColor(ink), _LINE_PX))
    painter.setBrush(QColor(ink))
    painter.drawLine(bar)
    half = 2.0 * _LINE_PX
    mark = QRectF(value.x() - half, value.y() - half, 2 * half, 2 * half)
    if square:
        painter.drawRect(mark)
    else:
        painter.drawEllipse(mark)
