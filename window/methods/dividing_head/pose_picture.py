"""A picture of the unit in one of its mounts, drawn from the same geometry that the analysis uses."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours
from tumble.window.methods.dividing_head.mounts import mount_name

_HALF_SIZES: Final = (0.62, 0.42, 0.16)
"""Of the unit along Ox, Oy, Oz: a flat box whose axes cannot be taken for each other."""
_RIGHT: Final = np.array([0.90, 0.0, -0.43])
_UP: Final = np.array([-0.16, 0.93, -0.34])
"""On the paper, of X to the right, Y up and Z, the head's axis, towards the reader."""
_TOWARDS: Final = np.cross(_RIGHT, _UP)
_ARROW: Final = 1.15
_ZERO_LABEL: Final = (0.3, 1.4)
"""Where the mark of 0° is named: outside the rim, beside any axis of the unit that points there."""
_SHADOWS: Final = {(0, 1): 0.22, (1, 1): 0.32, (2, 1): 0.14, (0, -1): 0.26, (1, -1): 0.36, (2, -1): 0.18}
"""Of every face, by its axis and side: the share of the accent in the paper."""
_CASING_PX: Final = 2.5
"""Of paper around an arrow and a letter, by which they stand out from what they lie on."""


@dataclass(frozen=True, kw_only=True)
class _Face:
    corners: FloatArray
    axis: int
    sign: int


class PosePicture(QWidget):
    """The faceplate of the head, the unit on it with its axes, and gravity, at head angle 0."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._mount = ""
        self.setMinimumSize(200, 170)

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """Large enough for a look from the head."""
        return QSize(420, 340)

    def show_mount(self, mount: str) -> None:
        """Show a mount; an empty name for none."""
        self._mount = mount
        self.setAccessibleName(mount_name(mount))
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or text size."""
        super().changeEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it, what is farther away first."""
        if self._mount not in MOUNTS:
            return
        painter, chosen = QPainter(self), colours(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(self.width() * 0.5, self.height() * 0.52)
        scale = min(self.width() / 3.5, self.height() / 3.0)
        axes = MOUNTS[self._mount]
        self._draw_plate(painter, chosen, scale, _seat_z(axes))
        hidden = [axis for axis in range(3) if axes[axis] @ _TOWARDS < 0]
        for axis in hidden:
            self._draw_axis(painter, chosen, scale, axes, axis)
        for face in _visible_faces(axes):
            self._draw_face(painter, chosen, scale, face)
        for axis in set(range(3)) - set(hidden):
            self._draw_axis(painter, chosen, scale, axes, axis)
        self._draw_gravity(painter, chosen, scale)

    def _draw_plate(self, painter: QPainter, chosen: Colours, scale: float, seat_z: float) -> None:
        turn = np.linspace(0.0, 2 * np.pi, 73)
        rim = np.stack([np.sin(turn), np.cos(turn), np.zeros_like(turn)], axis=-1) * 1.25
        for depth in (seat_z - 0.18, seat_z):
            painter.setPen(QPen(QColor(chosen.pale), 1.5))
            painter.setBrush(QColor(chosen.other_row))
            painter.drawPolygon(_polygon(rim + np.array([0.0, 0.0, depth]), scale))
        painter.drawLine(_flat(np.array([0, 1.25, seat_z]), scale), _flat(np.array([0, 1.08, seat_z]), scale))
        _write(
            painter,
            _flat(np.array([*_ZERO_LABEL, seat_z]), scale),
            "0°",
            QColor(chosen.ink),
            scale * 0.13,
            QColor(chosen.other_row),
        )

    def _draw_face(self, painter: QPainter, chosen: Colours, scale: float, face: _Face) -> None:
        painter.setPen(QPen(QColor(chosen.ink), 1.5))
        painter.setBrush(_between(QColor(chosen.paper), QColor(chosen.accent), _SHADOWS[face.axis, face.sign]))
        painter.drawPolygon(_polygon(face.corners, scale))
        if face.axis == 2 and face.sign > 0:  # the mark that a package carries on its lid
            mark = face.corners[0] * 0.75 + face.corners[2] * 0.25
            painter.setBrush(QColor(chosen.paper))
            painter.drawEllipse(_flat(mark, scale), scale * 0.06, scale * 0.06)

    def _draw_axis(self, painter: QPainter, chosen: Colours, scale: float, axes: FloatArray, axis: int) -> None:
        colour = QColor(chosen.data[(1, 2, 0)[axis]])
        begin, end = _flat(axes[axis] * _HALF_SIZES[axis], scale), _flat(axes[axis] * _ARROW, scale)
        around = QColor(chosen.paper)
        _arrow(painter, begin, end, around, scale, _CASING_PX)
        _arrow(painter, begin, end, colour, scale)
        _write(painter, _flat(axes[axis] * (_ARROW + 0.18), scale), "xyz"[axis], colour, scale * 0.2, around)

    def _draw_gravity(self, painter: QPainter, chosen: Colours, scale: float) -> None:
        """Down on the paper is down in the room."""
        begin, end = QPointF(1.5 * scale, -0.35 * scale), QPointF(1.5 * scale, 0.45 * scale)
        _arrow(painter, begin, end, QColor(chosen.ink), scale)
        _write(painter, QPointF(1.5 * scale, 0.65 * scale), "g", QColor(chosen.ink), scale * 0.2, QColor(chosen.paper))


def _seat_z(axes: FloatArray) -> float:
    """Where the faceplate is: under the unit."""
    return -float(np.abs(axes[:, 2]) @ np.array(_HALF_SIZES))


def _visible_faces(axes: FloatArray) -> list[_Face]:
    """The faces that look towards the reader, the farther ones first."""
    faces = [_face(axes, axis, sign) for axis in range(3) for sign in (1, -1) if sign * axes[axis] @ _TOWARDS > 1e-9]
    return sorted(faces, key=lambda face: float(face.corners.mean(axis=0) @ _TOWARDS))


def _face(axes: FloatArray, axis: int, sign: int) -> _Face:
    across, along = (other for other in range(3) if other != axis)
    middle = sign * axes[axis] * _HALF_SIZES[axis]
    a, b = axes[across] * _HALF_SIZES[across], axes[along] * _HALF_SIZES[along]
    return _Face(
        corners=np.array([middle + a + b, middle - a + b, middle - a - b, middle + a - b]), axis=axis, sign=sign
    )


def _flat(point: FloatArray, scale: float) -> QPointF:
    return QPointF(float(point @ _RIGHT) * scale, -float(point @ _UP) * scale)


def _polygon(points: FloatArray, scale: float) -> QPolygonF:
    return QPolygonF([_flat(point, scale) for point in points])


def _arrow(
    painter: QPainter, begin: QPointF, end: QPointF, colour: QColor, scale: float, wider_px: float = 0.0
) -> None:
    width_px = max(2.0, scale * 0.035) + 2 * wider_px
    painter.setPen(QPen(colour, width_px, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
    painter.drawLine(begin, end)
    way = end - begin
    length = max((way.x() ** 2 + way.y() ** 2) ** 0.5, 1e-9)
    along = way / length * scale * 0.12
    across = QPointF(-along.y(), along.x()) * 0.5
    painter.setBrush(colour)
    painter.drawPolygon(QPolygonF([end + along * 0.3, end - along + across, end - along - across]))


def _write(painter: QPainter, place: QPointF, text: str, colour: QColor, size: float, around: QColor) -> None:
    font = painter.font()
    font.setPixelSize(max(9, round(size)))
    font.setBold(True)
    painter.setFont(font)
    metrics = painter.fontMetrics()
    at = place + QPointF(-metrics.horizontalAdvance(text) / 2, metrics.ascent() / 2 - 1)
    letters = QPainterPath()
    letters.addText(at, font, text)
    painter.strokePath(letters, _casing(around))
    painter.setPen(colour)
    painter.drawText(at, text)


def _casing(colour: QColor) -> QPen:
    round_cap, round_join = Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin
    return QPen(colour, 2 * _CASING_PX, Qt.PenStyle.SolidLine, round_cap, round_join)


def _between(one: QColor, other: QColor, share: float) -> QColor:
    """A colour on the way from one to another."""
    red, green, blue = (
        round(a + share * (b - a))
        for a, b in (
            (one.red(), other.red()),
            (one.green(), other.green()),
            (one.blue(), other.blue()),
        )
    )
    return QColor(red, green, blue)
