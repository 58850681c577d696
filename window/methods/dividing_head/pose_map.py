"""Where a run is in its programme: every pose on a circle for its mount, done, now or to come."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QFontMetricsF, QPainter, QPaintEvent, QPen, QPolygonF
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
        self._placed: tuple[QSize, list[QPointF]] | None = None
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
        self._placed = None
        self.update()

    def begin(self, dwell: Dwell) -> None:
        """Mark a dwell as the one that is taken now."""
        self._now = pose_of(dwell)
        self.update()

    def complete(self, dwell: Dwell, point: Point) -> None:  # noqa: ARG002  # where, not what
        """Mark a dwell as done."""
        self._done[pose_of(dwell)] += 1
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or text size."""
        super().changeEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it."""
        painter, chosen = QPainter(self), colours(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        cells = self._cells()
        for mount, cell in cells.items():
            self._draw_circle(painter, chosen, mount, cell)
        self._draw_poses(painter, chosen, cells)
        if self._now in self._planned:
            self._draw_now(painter, chosen, cells[self._now[0]])

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

    def _draw_circle(self, painter: QPainter, chosen: Colours, mount: str, cell: Cell) -> None:
        painter.setPen(QPen(QColor(chosen.grid), 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(cell.centre, cell.radius, cell.radius)
        painter.setPen(QColor(chosen.ink))
        done = sum(count for (of, _), count in self._done.items() if of == mount)
        planned = sum(count for (of, _), count in self._planned.items() if of == mount)
        text, half = f"{mount_name(mount)}\n{done}/{planned}", _INSIDE * cell.radius
        room = QRectF(cell.centre.x() - half, cell.centre.y() - half, 2 * half, 2 * half)
        painter.setFont(fitting_font(self.font(), text, room))
        painter.drawText(room, _WRAPPED, text)

    def _draw_poses(self, painter: QPainter, chosen: Colours, cells: dict[str, Cell]) -> None:
        to_come, done = QPen(QColor(chosen.pale), 1.2), QPen(QColor(chosen.accent), 1.2)
        hollow, filled = QBrush(Qt.BrushStyle.NoBrush), QBrush(QColor(chosen.accent))
        painter.setPen(to_come)
        painter.setBrush(hollow)
        for (pose, planned), place in zip(self._planned.items(), self._places(cells), strict=True):
            share, size = self._done.get(pose, 0) / planned, self._size_in(cells[pose[0]])
            if not share:
                painter.drawEllipse(place, size, size)
                continue
            painter.setPen(done)
            painter.drawEllipse(place, size, size)
            painter.setBrush(filled)
            box = QRectF(place.x() - size, place.y() - size, 2 * size, 2 * size)
            painter.drawPie(box, 90 * 16, round(-360 * 16 * min(share, 1.0)))
            painter.setPen(to_come)
            painter.setBrush(hollow)

    def _places(self, cells: dict[str, Cell]) -> list[QPointF]:
        """Of every pose; they stay where they are until the map is as large as another one, or of another programme."""
        if self._placed is None or self._placed[0] != self.size():
            self._placed = self.size(), [_on(cells[mount], angle_deg) for mount, angle_deg in self._planned]
        return self._placed[1]

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


def fitting_font(font: QFont, text: str, room: QRectF) -> QFont:
    """The largest of a few sizes of a font in which a text, wrapped between words, has room; else the smallest."""
    usual_pt = font.pointSizeF()
    for scale in _SCALES:
        font.setPointSizeF(scale * usual_pt)
        needed = QFontMetricsF(font).boundingRect(room, _WRAPPED, text)
        if needed.width() <= room.width() and needed.height() <= room.height():
            break
    return font
