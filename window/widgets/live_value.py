"""What a meter reads while a stand is watched: the newest value, and a line through those before."""

import math
from collections import deque
from itertools import pairwise
from typing import Final

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QVBoxLayout, QWidget

from tumble.calibrations.core.arrays import FloatArray
from tumble.drivers.protocols import VOLTAGE, Block
from tumble.drivers.usable import OVERLOAD
from tumble.window.look.language import tr
from tumble.window.look.names import AIR
from tumble.window.look.numbers import local
from tumble.window.look.plain import PlainLabel
from tumble.window.look.theme import colours

_KEPT: Final = 150
"""Values, of up to five a second: half a minute and more."""
_TOLD: Final = 3
"""Channels whose values are told; the line is that of the first."""
_EDGE_PX: Final = 2.0
_LINE_PX: Final = 1.5
_DOT_PX: Final = 3.0


class LiveValue(QWidget):
    """Nothing until something was read."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.said, self.line = PlainLabel("—"), Sparkline()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.said)
        column.addWidget(self.line)
        self.line.hide()

    def see(self, block: Block | None) -> None:
        """Show what was read just now, the mean of a few samples; None where there are none."""
        if block is None:
            self._interrupt(tr("no value"))
            return
        means = {name: _mean(values) for name, values in block.channels.items()}
        self.said.setText("\n".join(_told(name, mean) for name, mean in list(means.items())[:_TOLD]))
        self.line.add(next(iter(means.values())))
        self.line.show()

    def pause(self) -> None:
        """Nothing is read for a while; what was read before stays in the line."""
        self._interrupt("—")

    def forget(self) -> None:
        """Nothing is read any more."""
        self.said.setText("—")
        self.line.forget()
        self.line.hide()

    def _interrupt(self, said: str) -> None:
        self.said.setText(said)
        self.line.interrupt()


class Sparkline(QWidget):
    """Values one after the other, from the lowest at the bottom to the highest on top."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.values: deque[float] = deque(maxlen=_KEPT)

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As high as a line of text and a half."""
        return QSize(120, round(1.5 * self.fontMetrics().height()))

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """The same, narrower."""
        return QSize(60, self.sizeHint().height())

    def add(self, value: float) -> None:
        """One value more; one that is no number is a gap."""
        self.values.append(value)
        self.update()

    def interrupt(self) -> None:
        """Leave a gap before the next value."""
        if self.values and math.isfinite(self.values[-1]):
            self.add(math.nan)

    def forget(self) -> None:
        """Begin anew."""
        self.values.clear()
        self.update()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette or text size."""
        super().changeEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802, ARG002  # Qt's name
        """Draw the line, and a dot where a value stands alone between two gaps."""
        values, colour = np.array(self.values), QColor(colours(self).accent)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for piece in _pieces(values, self.width(), self.height()):
            if len(piece) > 1:
                painter.setPen(QPen(colour, _LINE_PX))
                painter.drawPolyline(QPolygonF(piece))
            else:
                painter.setPen(QPen(colour, _DOT_PX, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
                painter.drawPoint(piece[0])


def _pieces(values: FloatArray, width: float, height: float) -> list[list[QPointF]]:
    """Where the values between two gaps are drawn, for each piece of the line."""
    places = _places(values, width, height)
    there = np.flatnonzero(np.isfinite(values))
    starts = np.flatnonzero(np.diff(there, prepend=-2) > 1).tolist()
    return [places[start:end] for start, end in pairwise([*starts, len(places)])]


def _places(values: FloatArray, width: float, height: float) -> list[QPointF]:
    """Where finite values are drawn, the newest at the right; all at half the height where none differs."""
    there = np.flatnonzero(np.isfinite(values))
    if not there.size:
        return []
    lowest, highest = values[there].min(), values[there].max()
    share = (values[there] - lowest) / (highest - lowest) if highest > lowest else np.full(there.size, 0.5)
    x = width - _EDGE_PX - (len(values) - 1 - there) * (width - 2 * _EDGE_PX) / (_KEPT - 1)
    y = height - _EDGE_PX - share * (height - 2 * _EDGE_PX)
    return [QPointF(*place) for place in zip(x, y, strict=True)]


def _mean(values: FloatArray) -> float:
    """Mean of samples; infinite where one of them is out of range, NaN where one is no number."""
    return math.inf if np.any(np.abs(values) >= OVERLOAD) else float(np.mean(values))


def _told(name: str, value: float) -> str:
    """A value with its unit where its channel is the only one that such an instrument has; else with its name."""
    if math.isfinite(value):
        return local({VOLTAGE: f"{value:.6f} V", AIR: f"{value:.2f} °C"}.get(name, f"{name}: {value:.6g}"))
    said = tr("overload") if math.isinf(value) else tr("no value")
    return said if name in (VOLTAGE, AIR) else f"{name}: {said}"
