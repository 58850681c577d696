"""Where the head is and where it was sent: a dial, and the angle in degrees and in degrees, minutes and seconds."""

import math
from typing import Final

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from tumble.drivers.manual import format_dms
from tumble.drivers.protocols import PositionerStatus
from tumble.window.look.language import tr
from tumble.window.look.numbers import local
from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours

_TICK_DEG: Final = 10
_LABEL_DEG: Final = 30
_HIDDEN_DEG: Final = 10
"""A label is left out where the needle is as near as that, and would lie on it."""
_LEAST_LINES: Final = 8.5
"""Its edge in lines of text."""
_THERE_DEG: Final = 0.01
"""What a head that is where it was sent may be away from there."""


class Dial(QWidget):
    """The circle of the head; 0° on top, clockwise as the circle of a head is engraved.

    A filled needle says where the head is, a hollow tip where it was sent: they lie upon each other once it is there.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._status: PositionerStatus | None = None

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """Readable from two metres where there is room."""
        return QSize(360, 360)

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """So large that what is written in it is no smaller than text beside it."""
        edge = round(_LEAST_LINES * self.fontMetrics().height())
        return QSize(edge, edge)

    def show_status(self, status: PositionerStatus | None) -> None:
        """Show where the head is; None, and a head that has not found its reference, where nobody knows."""
        self._status = status if status is not None and status.referenced else None
        self.setAccessibleName("" if self._status is None else _said(self._status))
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or text size."""
        super().changeEvent(event)
        self.updateGeometry()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it."""
        painter, chosen = QPainter(self), colours(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        radius = min(self.width(), self.height()) / 2 - 6
        painter.translate(QPointF(self.width() / 2, self.height() / 2))
        painter.setPen(QPen(QColor(chosen.grid), 2))
        painter.setBrush(QColor(chosen.paper))
        painter.drawEllipse(QPointF(), radius, radius)
        self._draw_scale(painter, chosen, radius)
        if self._status is not None:
            self._draw_needles(painter, chosen, radius, self._status)
        self._draw_text(painter, chosen, radius)

    def _draw_scale(self, painter: QPainter, chosen: Colours, radius: float) -> None:
        font = self.font()
        font.setPixelSize(max(9, round(radius * 0.09)))
        painter.setFont(font)
        for angle_deg in range(0, 360, _TICK_DEG):
            labelled = angle_deg % _LABEL_DEG == 0
            outer, inner = _on(radius - 3, angle_deg), _on(radius * (0.91 if labelled else 0.94), angle_deg)
            painter.setPen(QPen(QColor(chosen.ink if labelled else chosen.pale), 2 if labelled else 1))
            painter.drawLine(outer, inner)
            if labelled and not self._lies_on(angle_deg):
                place = _on(radius * 0.78, angle_deg)
                box = QRectF(place.x() - radius, place.y() - radius, 2 * radius, 2 * radius)
                painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(angle_deg))

    def _lies_on(self, label_deg: int) -> bool:
        """Whether the needle lies on the label of an angle."""
        if self._status is None:
            return False
        return abs(math.remainder(self._status.angle_deg - label_deg, 360.0)) < _HIDDEN_DEG

    def _draw_needles(self, painter: QPainter, chosen: Colours, radius: float, status: PositionerStatus) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(chosen.now if status.turning else chosen.accent))
        _draw_needle(painter, radius, status.angle_deg, foot=0.70, half_width=0.045)
        if status.target_deg is not None:
            painter.setPen(QPen(QColor(chosen.ink), max(1.5, radius * 0.014)))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            _draw_needle(painter, radius, status.target_deg, foot=0.85, half_width=0.075)

    def _draw_text(self, painter: QPainter, chosen: Colours, radius: float) -> None:
        lines = [("?", 0.22)] if self._status is None else _lines(self._status)
        painter.setPen(QColor(chosen.ink))
        top = -radius * 0.26
        for text, size in lines:
            font = self.font()
            font.setBold(True)
            font.setPixelSize(max(10, round(radius * size)))
            painter.setFont(font)
            box = QRectF(-radius * 0.68, top, radius * 1.36, radius * 0.3)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
            top += radius * 0.26


def _draw_needle(painter: QPainter, radius: float, angle_deg: float, *, foot: float, half_width: float) -> None:
    """Draw a needle that points outwards; where its foot is, and half of its width, are in parts of the radius."""
    painter.save()
    painter.rotate(math.fmod(angle_deg, 360.0))
    tip, base, half = -radius * 0.96, -radius * foot, radius * half_width
    painter.drawPolygon(QPolygonF([QPointF(0, tip), QPointF(half, base), QPointF(-half, base)]))
    painter.restore()


def _lines(status: PositionerStatus) -> list[tuple[str, float]]:
    """What is written in the dial, and how high, in parts of the radius."""
    here = [(_degrees(status.angle_deg), 0.22), (local(format_dms(status.angle_deg)), 0.17)]
    return [*here, (f"→ {target}", 0.13)] if (target := _ahead(status)) else here


def _said(status: PositionerStatus) -> str:
    """The same for a screen reader."""
    here, target = _degrees(status.angle_deg), _ahead(status)
    return tr("{angle}, sent to {target}", angle=here, target=target) if target else here


def _ahead(status: PositionerStatus) -> str:
    """Where it was sent; empty where it is there, or was not sent."""
    if status.target_deg is None or abs(status.target_deg - status.angle_deg) < _THERE_DEG:
        return ""
    return _degrees(status.target_deg)


def _degrees(angle_deg: float) -> str:
    return local(f"{angle_deg:.4f}°")


def _on(radius: float, angle_deg: float) -> QPointF:
    angle_rad = math.radians(angle_deg)
    return QPointF(radius * math.sin(angle_rad), -radius * math.cos(angle_rad))
