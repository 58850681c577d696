"""A value against its limits, painted as a bar; `tumble.calibrations.report.bars` draws the same for paper."""

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from tumble.calibrations.core.verdict import Outcome
from tumble.window.look.shades import Colours

if TYPE_CHECKING:
    from tumble.calibrations.report.limit_bar import LimitBar

_HIGH: Final = 0.7
"""Of the room: height of the part between the limits."""
_MARK: Final = 0.22
"""Of the room: half the size of the mark."""


def draw_bar(painter: QPainter, room: QRectF, bar: "LimitBar", chosen: Colours, *, ink: str = "") -> None:
    """Draw the room between the limits, and the value with its 95% interval over it, if it has one.

    The mark says the outcome: a disc passes, a cross fails, a ring is not decided; an arrow points to a value beyond
    the end of the bar. With `ink` all is drawn in that one colour, as on a row that is selected.
    """
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    first, last = (room.left() + place * room.width() for place in bar.inside)
    height = _HIGH * room.height()
    between = QRectF(first, room.center().y() - height / 2, last - first, height)
    painter.setPen(QPen(QColor(ink or chosen.outline), 1))
    for edge in (between.top(), between.bottom()):
        painter.drawLine(QLineF(first, edge, last, edge))
    painter.setPen(QPen(QColor(ink or chosen.ink), 2))
    for limit in (bar.minimum, bar.maximum):
        if limit is not None:
            x = room.left() + limit * room.width()
            painter.drawLine(QLineF(x, between.top(), x, between.bottom()))
    if bar.value is not None:
        _draw_value(painter, room, bar, bar.value, ink or _colour(bar.outcome, chosen))
    painter.restore()


def _draw_value(painter: QPainter, room: QRectF, bar: "LimitBar", value: float, colour: str) -> None:
    begin, end = (room.left() + place * room.width() for place in bar.interval)
    middle, size = QPointF(room.left() + value * room.width(), room.center().y()), _MARK * room.height()
    painter.setPen(QPen(QColor(colour), 2))
    painter.drawLine(QLineF(begin, middle.y(), end, middle.y()))
    if bar.beyond:
        _draw_arrow(painter, middle, size, bar.beyond)
    elif bar.outcome is Outcome.FAIL:
        painter.drawLine(middle + QPointF(-size, -size), middle + QPointF(size, size))
        painter.drawLine(middle + QPointF(-size, size), middle + QPointF(size, -size))
    else:
        painter.setBrush(QColor(colour) if bar.outcome is Outcome.PASS else Qt.BrushStyle.NoBrush)
        painter.drawEllipse(middle, size, size)


def _draw_arrow(painter: QPainter, middle: QPointF, size: float, side: int) -> None:
    painter.setBrush(painter.pen().color())
    tip, back = side * size, -side * size
    painter.drawPolygon(
        QPolygonF([middle + QPointF(tip, 0), middle + QPointF(back, -size), middle + QPointF(back, size)])
    )


def _colour(outcome: Outcome, chosen: Colours) -> str:
    return {Outcome.PASS: chosen.good, Outcome.FAIL: chosen.bad}.get(outcome, chosen.now)
