"""The values of the point next to the mouse, or of the one that the arrow keys have come to."""

from collections.abc import Callable
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QLineF, QObject, QPointF, QRectF, QSizeF, Qt, QTimer
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from tumble.window.look.numbers import local
from tumble.window.look.theme import colours
from tumble.window.plots.sight import Point, Sight, sight_of
from tumble.window.plots.values import Values, told

_REACH_PX: Final = 40.0
"""How far from the mouse a point may be."""
_RING_PX: Final = 6.0
_GAP_PX: Final = 8.0
_AGAIN_MS: Final = 500
"""What is drawn may change below the mouse: so often it is looked at anew."""


class Crosshair(QWidget):
    """Lies over a plot: lines through the point, a ring around it, and its values; nothing where there is none."""

    def __init__(self, plot: pg.PlotWidget, values: Callable[[], Values]) -> None:
        super().__init__(plot.viewport())
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._plot, self._values, self._mouse = plot, values, QPointF()
        self.point: Point | None = None
        self._number = 0
        """Of the series of the point, in the order in which the plot states them."""
        self.text = ""
        """What it says, a line for each value."""
        self._again = QTimer(self, interval=_AGAIN_MS)
        self._again.timeout.connect(lambda: self.point_at(self._mouse))
        self.hide()
        plot.viewport().installEventFilter(self)

    def point_at(self, place: QPointF) -> None:
        """Go to the point next to a place of the viewport, in pixels, if one is near."""
        self._mouse, sight = place, sight_of(self._plot)
        series = enumerate(self._values().series)
        found = [(*near, number) for number, each in series if (near := sight.nearest(each, place))]
        far, point, number = min(found, key=lambda near: near[0], default=(_REACH_PX, None, 0))
        if point is None or far >= _REACH_PX:
            self.forget()
            return
        self._show(point, number, sight)
        self._again.start()

    def step(self, by: int) -> None:
        """Go to the next point of the series, to the left with -1; at first to the leftmost of the first series."""
        seen, sight = self._seen()
        if not seen:
            self.forget()
            return
        number, points = seen[self._series_in(seen)]
        self._show(points[_kept(self._index_in(points) + by * bool(self.point), points)], number, sight)
        self._again.stop()

    def change_series(self, by: int) -> None:
        """Go to the point of the next series, with -1 of the one before, whose abscissa is nearest."""
        seen, sight = self._seen()
        if not seen:
            self.forget()
            return
        number, points = seen[(self._series_in(seen) + by * bool(self.point)) % len(seen)]
        self._show(points[_nearest_along(points, self.point)], number, sight)
        self._again.stop()

    def forget(self) -> None:
        """Show no point."""
        self._again.stop()
        self.point, self.text = None, ""
        self._plot.setAccessibleDescription("")
        self.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Follow the mouse, but where it drags."""
        match event.type():
            case QEvent.Type.MouseMove if isinstance(event, QMouseEvent):
                if event.buttons() == Qt.MouseButton.NoButton:
                    self.point_at(event.position())
                else:
                    self.forget()
            case QEvent.Type.Leave | QEvent.Type.Wheel:
                self.forget()
        return super().eventFilter(watched, event)

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw lines, ring and values."""
        if self.point is None:
            return
        chosen, sight = colours(self), sight_of(self._plot)
        at, room = sight.pixel_of(self.point), sight.room
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(QColor(chosen.pale), 1, Qt.PenStyle.DashLine))
        painter.drawLine(QLineF(at.x(), room.top(), at.x(), room.bottom()))
        painter.drawLine(QLineF(room.left(), at.y(), room.right(), at.y()))
        painter.setPen(QPen(QColor(chosen.now), 2))
        painter.drawEllipse(at, _RING_PX, _RING_PX)
        box = self._box(at)
        painter.setBrush(QColor(chosen.paper))
        painter.setPen(QPen(QColor(chosen.outline), 1))
        painter.drawRect(box)
        painter.setPen(QColor(chosen.ink))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self.text)

    def _show(self, point: Point, number: int, sight: Sight) -> None:
        self.point, self._number = point, number
        self.text = local(self._told(point, sight))
        self._plot.setAccessibleDescription(self.text)
        self.setGeometry(self._plot.viewport().rect())
        self.show()
        self.raise_()
        self.update()

    def _told(self, point: Point, sight: Sight) -> str:
        values, series, (x, y) = self._values(), point.series, point.place
        across = series.x_texts[point.index] if series.x_texts else told(values.bottom, x, sight.x[1] - sight.x[0])
        lines = (series.name, across, told(values.left, y, sight.y[1] - sight.y[0]))
        return "\n".join(filter(None, lines))

    def _seen(self) -> tuple[list[tuple[int, list[Point]]], Sight]:
        """The points in sight of every series that has some, with its number."""
        sight = sight_of(self._plot)
        series = enumerate(self._values().series)
        return [(number, points) for number, each in series if (points := sight.seen(each))], sight

    def _series_in(self, seen: list[tuple[int, list[Point]]]) -> int:
        """Where the series of the point that is shown stands among those in sight; 0 without one."""
        numbers = [number for number, _ in seen]
        return numbers.index(self._number) if self.point and self._number in numbers else 0

    def _index_in(self, points: list[Point]) -> int:
        """Where the point that is shown stands among the points of its series; the leftmost without one."""
        index = self.point.index if self.point else None
        return next((place for place, each in enumerate(points) if each.index == index), 0)

    def _box(self, at: QPointF) -> QRectF:
        """Where the values stand: above and to the right of the point, or on its other side where there is no room."""
        lines = self.text.split("\n")
        metrics = self.fontMetrics()
        wide = max(map(metrics.horizontalAdvance, lines)) + 2 * _GAP_PX
        size = QSizeF(wide, metrics.height() * len(lines) + _GAP_PX)
        left = at.x() + _GAP_PX if at.x() + _GAP_PX + wide <= self.width() else at.x() - _GAP_PX - wide
        top = at.y() - _GAP_PX - size.height()
        return QRectF(QPointF(max(left, 0.0), top if top >= 0 else at.y() + _GAP_PX), size)


def _kept(place: int, points: list[Point]) -> int:
    return min(max(place, 0), len(points) - 1)


def _nearest_along(points: list[Point], point: Point | None) -> int:
    """Which of some points has the abscissa of another, or the nearest to it; the leftmost without one."""
    if point is None:
        return 0
    return min(range(len(points)), key=lambda place: abs(points[place].place[0] - point.place[0]))
