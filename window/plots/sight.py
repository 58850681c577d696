"""What of a plot is in sight, and where on the screen its points are."""

from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF

from tumble.calibrations.core.arrays import FloatArray
from tumble.window.plots.values import Series


@dataclass(frozen=True, kw_only=True)
class Point:
    """One point of a plot."""

    series: Series
    index: int

    @property
    def place(self) -> tuple[float, float]:
        """Its abscissa and its value."""
        return float(self.series.x[self.index]), float(self.series.y[self.index])


@dataclass(frozen=True, kw_only=True)
class Sight:
    """The ranges that the axes show, and the part of the plot's viewport, in pixels, in which they do."""

    x: tuple[float, float]
    y: tuple[float, float]
    room: QRectF

    def pixels(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Where points are in the viewport, shape (2, points)."""
        across = (x - self.x[0]) / (self.x[1] - self.x[0])
        up = (y - self.y[0]) / (self.y[1] - self.y[0])
        return np.array([self.room.left() + across * self.room.width(), self.room.bottom() - up * self.room.height()])

    def pixel_of(self, point: Point) -> QPointF:
        """Where a point is in the viewport."""
        x, y = point.place
        return QPointF(*self.pixels(np.array([x]), np.array([y]))[:, 0])

    def seen(self, series: Series) -> list[Point]:
        """The points of a series that are in sight, from left to right."""
        inside = (series.x >= self.x[0]) & (series.x <= self.x[1]) & (series.y >= self.y[0]) & (series.y <= self.y[1])
        places = np.flatnonzero(inside)  # what is no number lies in no range
        return [Point(series=series, index=int(each)) for each in places[np.argsort(series.x[places], kind="stable")]]

    def nearest(self, series: Series, place: QPointF) -> tuple[float, Point] | None:
        """The point of a series nearest to a place of the viewport, and how far it is, in pixels; None without any."""
        across, down = self.pixels(series.x, series.y)
        far = np.hypot(across - place.x(), down - place.y())
        far[~np.isfinite(far)] = np.inf
        if not far.size or not np.isfinite(far.min()):
            return None
        index = int(far.argmin())
        return float(far[index]), Point(series=series, index=index)


def sight_of(plot: pg.PlotWidget) -> Sight:
    """What of a plot is in sight now."""
    box = plot.getViewBox()
    (left, right), (low, high) = box.viewRange()
    room = QRectF(plot.mapFromScene(box.sceneBoundingRect()).boundingRect())
    return Sight(x=(left, right), y=(low, high), room=room)
