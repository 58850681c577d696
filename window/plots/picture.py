"""A plot as it is seen, drawn for a file: PNG or SVG."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import QBuffer, QRect, QRectF, QSize
from PySide6.QtGui import QImage, QPainter
from PySide6.QtSvg import QSvgGenerator

_SHARPNESS: Final = 2
"""Pixels of a file for one of the screen, along each side."""


@dataclass(frozen=True, kw_only=True)
class Drawn:
    """A plot as it was seen, as files hold it."""

    png: bytes
    svg: bytes


def drawn(plot: pg.PlotWidget) -> Drawn:
    """Draw a plot as it is seen now."""
    with _as_vectors(plot):
        return Drawn(png=_png(plot), svg=_svg(plot))


def _png(plot: pg.PlotWidget) -> bytes:
    image = QImage(plot.viewport().size() * _SHARPNESS, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    plot.render(painter, QRectF(image.rect()), plot.viewport().rect())
    painter.end()
    buffer = QBuffer()
    image.save(buffer, "PNG")  # type: ignore[call-overload]  # it takes no bytes, whatever is declared
    return bytes(buffer.data().data())


def _svg(plot: pg.PlotWidget) -> bytes:
    room, buffer = QRect(plot.viewport().rect()), QBuffer()
    generator = QSvgGenerator()
    generator.setOutputDevice(buffer)
    generator.setSize(QSize(room.width(), room.height()))
    generator.setViewBox(room)
    generator.setTitle(plot.accessibleName())
    painter = QPainter(generator)
    painter.fillRect(room, plot.backgroundBrush())
    plot.render(painter, QRectF(room), room)
    painter.end()
    return bytes(buffer.data().data())


@contextmanager
def _as_vectors(plot: pg.PlotWidget) -> Iterator[None]:
    """Have points drawn as shapes; on the screen they are copies of small pictures."""
    items = [item for item in plot.scene().items() if hasattr(item, "setExportMode")]
    for item in items:
        item.setExportMode(True, {"antialias": True})
    try:
        yield
    finally:
        for item in items:
            item.setExportMode(False)
