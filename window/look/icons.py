"""Signs of the screens, painted in the colours of the window."""

import math
from collections.abc import Callable, Mapping
from typing import Final

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QIcon, QPainter, QPen, QPixmap, QPolygonF

_PX: Final = 96
"""Edge of what is painted; it is shown smaller."""
_UNIT: Final = 24.0
"""Edge of the field in which the signs are described."""
_LINE: Final = 1.8


def icon(name: str, ink: str, chosen_ink: str) -> QIcon:
    """A sign in one colour, and in another where its button is pressed."""
    made = QIcon()
    made.addPixmap(painted(_SIGNS[name], ink), QIcon.Mode.Normal, QIcon.State.Off)
    made.addPixmap(painted(_SIGNS[name], chosen_ink), QIcon.Mode.Normal, QIcon.State.On)
    return made


def window_icon() -> QIcon:
    """The sign of the program, for the desktop."""
    return QIcon(painted(_stand, "#0072B2"))


def painted(sign: Callable[[QPainter], None], ink: str) -> QPixmap:
    """A sign, which is described in a field of 24 by 24, in a colour."""
    pixmap = QPixmap(_PX, _PX)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.scale(_PX / _UNIT, _PX / _UNIT)
    pen = QPen(QColor(ink), _LINE)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    painter.setPen(pen)
    sign(painter)
    painter.end()
    return pixmap


def _stand(painter: QPainter) -> None:
    """A dial with its needle."""
    painter.drawEllipse(QPointF(12, 12), 9, 9)
    for angle_deg in range(0, 360, 90):
        painter.drawLine(_on(9, angle_deg), _on(7, angle_deg))
    painter.drawLine(QPointF(12, 12), _on(6, 40))
    painter.drawPoint(QPointF(12, 12))


def _run(painter: QPainter) -> None:
    """What starts."""
    painter.drawEllipse(QPointF(12, 12), 9, 9)
    painter.setBrush(painter.pen().color())
    painter.drawPolygon(QPolygonF([QPointF(10, 8.5), QPointF(16, 12), QPointF(10, 15.5)]))


def _result(painter: QPainter) -> None:
    """Values with their errors."""
    painter.drawPolyline(QPolygonF([QPointF(4, 3), QPointF(4, 20), QPointF(21, 20)]))
    for x, y, half in ((8.5, 13, 3.0), (13, 9, 2.5), (17.5, 11, 3.5)):
        painter.drawLine(QPointF(x, y - half), QPointF(x, y + half))
        painter.setBrush(painter.pen().color())
        painter.drawEllipse(QPointF(x, y), 0.9, 0.9)


def _records(painter: QPainter) -> None:
    """Sheets with lines on them."""
    painter.drawRoundedRect(QRectF(5, 3, 14, 18), 2, 2)
    for y in (8, 12, 16):
        painter.drawLine(QPointF(8.5, y), QPointF(15.5, y))


def _settings(painter: QPainter) -> None:
    """Three sliders."""
    for y, knob in ((6, 15.5), (12, 8.5), (18, 13)):
        painter.drawLine(QPointF(4, y), QPointF(20, y))
        painter.setBrush(painter.pen().color())
        painter.drawEllipse(QPointF(knob, y), 2, 2)


def _help(painter: QPainter) -> None:
    """A question."""
    painter.drawEllipse(QPointF(12, 12), 9, 9)
    font = QFont(painter.font())
    font.setBold(True)
    font.setPixelSize(13)
    painter.setFont(font)
    painter.drawText(QRectF(0, 0, _UNIT, _UNIT), Qt.AlignmentFlag.AlignCenter, "?")


def _on(radius: float, angle_deg: float) -> QPointF:
    angle_rad = math.radians(angle_deg)
    return QPointF(12 + radius * math.sin(angle_rad), 12 - radius * math.cos(angle_rad))


_SIGNS: Final[Mapping[str, Callable[[QPainter], None]]] = {
    "stand": _stand,
    "run": _run,
    "result": _result,
    "records": _records,
    "settings": _settings,
    "help": _help,
}
