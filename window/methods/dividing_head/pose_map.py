"""Where a run is in its programme: every pose on a circle for its mount, done, now or to come."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from tumble.procedures.layout import Layout
from tumble.procedures.methods.dividing_head.layout import HEAD, MOUNT
from tumble.procedures.steps import Dwell, Point
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.parts import Overview

Pose: TypeAlias = tuple[str, float]
"""Mount and head angle within the turn."""
_NEVER: Final = ("", math.nan)
_INSIDE: Final = 0.74
"""Half of the width of what is written into a circle, in its radius: its corners lie on the circle at 0.71."""
_SCALES: Final = (1.0, 0.9, 0.8, 0.7, 0.6)
"""Sizes of what is written there."""
_WRAPPED: Final = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap


@dataclass(frozen=True, kw_only=True)
class Cell:
    """Where the circle of a mount lies."""

    centre: QPointF
    radius: float


def pose_of(dwell: Dwell) -> Pose:
    """The pose of a dwell."""
    return dwell.conditions[MOUNT], round(dwell.targets_deg[HEAD] % 360.0, 1)


class PoseMap(Overview):
    """Filled marks are done, half filled ones in some realisations, hollow ones are to come; a diamond is now."""

    def __init__(self, _: Layout, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._planned: Counter[Pose] = Counter()
        self._done: Counter[Pose] = Counter()
        self._now: Pose = _NEVER
        self._picture: QPixmap | None = None
        """Circles and poses as they were drawn last: all of a long programme at each point would be felt."""
        self.setMinimumSize(220, 130)

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """Room for two circles beside each other."""
        return QSize(420, 240)

    @property
    def done(self) -> int:
        """Number of dwells that are done."""
        return self._done.total()

    @property
    def mounts(self) -> list[str]:
        """The mounts of the programme in the order in which they first come."""
        return list(dict.fromkeys(mount for mount, _ in self._planned))

    def show_plan(self, dwells: Sequence[Dwell], points: Sequence[Point] = ()) -> None:
        """Show a programme, with the dwells done of which there are points."""
        poses = [pose_of(dwell) for dwell in dwells]
        self._planned, self._done, self._now = Counter(poses), Counter(poses[: len(points)]), _NEVER
        self._picture = None
        self.update()

    def begin(self, dwell: Dwell) -> None:
        """Mark a dwell as the one that is taken now."""
        self._now = pose_of(dwell)
        self.update()

    def complete(self, dwell: Dwell, point: Point) -> None:  # noqa: ARG002  # where, not what
        """Mark a dwell as done."""
        pose = pose_of(dwell)
        self._done[pose] += 1
        if self._picture is not None and pose in self._planned:
            painter = _on_paper(self._picture)
            self._draw_pose(painter, colours(self), pose, self._cells()[pose[0]])
            painter.end()
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or text size."""
        super().changeEvent(event)
        self._picture = None
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Have other circles."""
        super().resizeEvent(event)
        self._picture = None

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it."""
        painter, chosen, cells = QPainter(self), colours(self), self._cells()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._picture = self._picture or self._drawn(chosen, cells)
        painter.drawPixmap(0, 0, self._picture)
        painter.setPen(QColor(chosen.ink))
        for mount, cell in cells.items():
            self._write(painter, mount, cell)
        if self._now in self._planned:
            self._draw_now(painter, chosen, cells[self._now[0]])

    def _drawn(self, chosen: Colours, cells: dict[str, Cell]) -> QPixmap:
        """Circles and poses."""
        ratio = self.devicePixelRatioF()
        picture = QPixmap(self.size() * ratio)
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        painter = _on_paper(picture)
        painter.setPen(QPen(QColor(chosen.grid), 1))
        for cell in cells.values():
            painter.drawEllipse(cell.centre, cell.radius, cell.radius)
        for pose in self._planned:
            self._draw_pose(painter, chosen, pose, cells[pose[0]])
        painter.end()
        return picture

    def _cells(self) -> dict[str, Cell]:
        """One cell for each mount, as large as they can be."""
        mounts = self.mounts
        columns = max(range(1, len(mounts) + 1), key=self._radius_in, default=1)
        rows = -(-len(mounts) // columns)
        width, height = self.width() / columns, self.height() / max(rows, 1)
        radius = self._radius_in(columns)
        return {
            mount: Cell(
                centre=QPointF((number % columns + 0.5) * width, (number // columns + 0.5) * height), radius=radius
            )
            for number, mount in enumerate(mounts)
        }

    def _radius_in(self, columns: int) -> float:
        rows = -(-max(len(self.mounts), 1) // columns)
        return min(self.width() / columns, self.height() / rows) / 2 - 10.0

    def _write(self, painter: QPainter, mount: str, cell: Cell) -> None:
        """What a circle is called, and how much of it is done."""
        done = sum(count for (of, _), count in self._done.items() if of == mount)
        planned = sum(count for (of, _), count in self._planned.items() if of == mount)
        text, half = f"{mount_name(mount)}\n{done}/{planned}", _INSIDE * cell.radius
        room = QRectF(cell.centre.x() - half, cell.centre.y() - half, 2 * half, 2 * half)
        painter.setFont(fitting_font(self.font(), text, room))
        painter.drawText(room, _WRAPPED, text)

    def _draw_pose(self, painter: QPainter, chosen: Colours, pose: Pose, cell: Cell) -> None:
        """Draw a pose over what it was before, of which there was never more."""
        share, size, place = self._done.get(pose, 0) / self._planned[pose], self._size_in(cell), _on(cell, pose[1])
        painter.setPen(QPen(QColor(chosen.accent if share else chosen.pale), 1.2))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(place, size, size)
        if share:
            painter.setBrush(QColor(chosen.accent))
            box = QRectF(place.x() - size, place.y() - size, 2 * size, 2 * size)
            painter.drawPie(box, 90 * 16, round(-360 * 16 * min(share, 1.0)))

    def _draw_now(self, painter: QPainter, chosen: Colours, cell: Cell) -> None:
        place, size = _on(cell, self._now[1]), max(6.0, cell.radius * 0.11)
        painter.setPen(QPen(QColor(chosen.paper), 1.5))
        painter.setBrush(QColor(chosen.now))
        corners = [QPointF(0, -size), QPointF(size, 0), QPointF(0, size), QPointF(-size, 0)]
        painter.drawPolygon(QPolygonF([place + corner for corner in corners]))

    def _size_in(self, cell: Cell) -> float:
        """Half of the width of a pose, in pixels."""
        return max(2.2, min(0.3 * self.fontMetrics().height(), cell.radius * 0.06))


def _on(cell: Cell, angle_deg: float) -> QPointF:
    angle_rad = math.radians(angle_deg)
    return cell.centre + QPointF(math.sin(angle_rad), -math.cos(angle_rad)) * cell.radius


def _on_paper(picture: QPixmap) -> QPainter:
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    return painter


def fitting_font(font: QFont, text: str, room: QRectF) -> QFont:
    """The largest of a few sizes of a font in which a text, wrapped between words, has room; else the smallest."""
    usual_pt = font.pointSizeF()
    for scale in _SCALES:
        font.setPointSizeF(scale * usual_pt)
        needed = QFontMetricsF(font).boundingRect(room, _WRAPPED, text)
        if needed.width() <= room.width() and needed.height() <= room.height():
            break
    return font
