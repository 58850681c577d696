"""A small lamp: what it says is in its shape as well as in its colour, and beside it in words."""

from enum import Enum, auto
from typing import Final

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from tumble.window.look.shades import Colours
from tumble.window.look.theme import colours

_LINES: Final = 0.8
"""Its edge in lines of text."""


class Light(Enum):
    """What a lamp says."""

    GOOD = auto()
    """A filled circle."""
    SOON = auto()
    """A filled triangle: something is to be done before long."""
    BAD = auto()
    """A cross in a filled square."""
    UNKNOWN = auto()
    """A ring."""


class Lamp(QWidget):
    """Grows with the text; says nothing to a screen reader, which reads the words beside it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.light = Light.UNKNOWN
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    def show_light(self, light: Light) -> None:
        """Say something else."""
        self.light = light
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """A square that is a little less high than a line of text."""
        edge = round(_LINES * self.fontMetrics().height())
        return QSize(edge, edge)

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """The same."""
        return self.sizeHint()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or text size."""
        super().changeEvent(event)
        self.updateGeometry()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw it."""
        painter, edge = QPainter(self), min(self.width(), self.height())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(QPointF(self.width() / 2, self.height() / 2))
        painter.scale(edge / 2, edge / 2)
        _draw(painter, self.light, colours(self))


def _draw(painter: QPainter, light: Light, chosen: Colours) -> None:
    """Draw it in a square from -1 to 1."""
    match light:
        case Light.GOOD:
            _fill(painter, chosen.good)
            painter.drawEllipse(QPointF(), 0.85, 0.85)
        case Light.SOON:
            _fill(painter, chosen.now)
            painter.drawPolygon(QPolygonF([QPointF(0, -0.9), QPointF(0.95, 0.8), QPointF(-0.95, 0.8)]))
        case Light.BAD:
            _fill(painter, chosen.bad)
            painter.drawRect(QRectF(-0.9, -0.9, 1.8, 1.8))
            painter.setPen(QPen(QColor(chosen.paper), 0.28))
            painter.drawLine(QPointF(-0.45, -0.45), QPointF(0.45, 0.45))
            painter.drawLine(QPointF(-0.45, 0.45), QPointF(0.45, -0.45))
        case Light.UNKNOWN:
            painter.setPen(QPen(QColor(chosen.pale), 0.25))
            painter.drawEllipse(QPointF(), 0.7, 0.7)


def _fill(painter: QPainter, colour: str) -> None:
    painter.setPen(QColor(0, 0, 0, 0))
    painter.setBrush(QColor(colour))
