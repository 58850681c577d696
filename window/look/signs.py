"""Signs in the rows of a table: a shape each, in a colour that goes with it, and the same on a row that is chosen."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QIcon, QPainter, QPolygonF

from tumble.window.look.icons import painted
from tumble.window.look.shades import Colours

Ink: TypeAlias = Literal["good", "bad", "now", "pale", "accent"]
"""A colour of `Colours`, by its name there."""


@dataclass(frozen=True, kw_only=True)
class Sign:
    """What is painted, and in which ink."""

    shape: str
    ink: Ink


TICK: Final = Sign(shape="tick", ink="good")
CROSS: Final = Sign(shape="cross", ink="bad")
QUESTION: Final = Sign(shape="question", ink="now")
DASH: Final = Sign(shape="dash", ink="pale")
EFFECT: Final = Sign(shape="diamond", ink="accent")
UNNAMED: Final = Sign(shape="wave", ink="now")
CORRECTED: Final = Sign(shape="full circle", ink="good")
UNCORRECTED: Final = Sign(shape="circle", ink="pale")
SIMULATED: Final = Sign(shape="dotted square", ink="accent")


def sign_icon(sign: Sign, colours: Colours) -> QIcon:
    """A sign in the colours of the window."""
    paint = _SHAPES[sign.shape]
    icon = QIcon(painted(paint, getattr(colours, sign.ink)))
    icon.addPixmap(painted(paint, colours.highlighted), QIcon.Mode.Selected)
    return icon


def _tick(painter: QPainter) -> None:
    painter.drawPolyline(QPolygonF([QPointF(4, 13), QPointF(10, 19), QPointF(20, 5)]))


def _cross(painter: QPainter) -> None:
    painter.drawLine(QPointF(5, 5), QPointF(19, 19))
    painter.drawLine(QPointF(5, 19), QPointF(19, 5))


def _question(painter: QPainter) -> None:
    painter.drawArc(QRectF(7, 3, 10, 10), -60 * 16, 240 * 16)
    painter.drawLine(QPointF(14.5, 12.3), QPointF(12, 16))
    painter.drawPoint(QPointF(12, 20.5))


def _dash(painter: QPainter) -> None:
    painter.drawLine(QPointF(6, 12), QPointF(18, 12))


def _diamond(painter: QPainter) -> None:
    painter.setBrush(painter.pen().color())
    painter.drawPolygon(QPolygonF([QPointF(12, 4), QPointF(20, 12), QPointF(12, 20), QPointF(4, 12)]))


def _wave(painter: QPainter) -> None:
    painter.drawArc(QRectF(3, 7, 9, 10), 0, 180 * 16)
    painter.drawArc(QRectF(12, 7, 9, 10), 180 * 16, 180 * 16)


def _circle(painter: QPainter) -> None:
    painter.drawEllipse(QPointF(12, 12), 7, 7)


def _full_circle(painter: QPainter) -> None:
    painter.setBrush(painter.pen().color())
    _circle(painter)


def _dotted_square(painter: QPainter) -> None:
    painter.drawRect(QRectF(5, 5, 14, 14))
    painter.setBrush(painter.pen().color())
    painter.drawEllipse(QPointF(12, 12), 2, 2)


_SHAPES: Final[Mapping[str, Callable[[QPainter], None]]] = {
    "tick": _tick,
    "cross": _cross,
    "question": _question,
    "dash": _dash,
    "diamond": _diamond,
    "wave": _wave,
    "circle": _circle,
    "full circle": _full_circle,
    "dotted square": _dotted_square,
}
