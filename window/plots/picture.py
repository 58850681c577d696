"""A plot as it is seen, written into a file: PNG or SVG."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import pyqtgraph as pg
from PySide6.QtCore import QByteArray, QRect, QRectF, QSize
from PySide6.QtGui import QImage, QImageWriter, QPainter
from PySide6.QtSvg import QSvgGenerator

_SHARPNESS: Final = 2
"""Pixels of a file for one of the screen, along each side."""


def save_png(plot: pg.PlotWidget, path: Path) -> None:
    """Write a picture in pixels. Raises `OSError`."""
    image = QImage(plot.viewport().size() * _SHARPNESS, QImage.Format.Format_RGB32)
    with _as_vectors(plot):
        painter = QPainter(image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        plot.render(painter, QRectF(image.rect()), plot.viewport().rect())
        painter.end()
    writer = QImageWriter(str(path), QByteArray(b"png"))
    if not writer.write(image):
        raise OSError(0, writer.errorString(), str(path))


def save_svg(plot: pg.PlotWidget, path: Path) -> None:
    """Write a picture of lines and texts."""
    room = QRect(plot.viewport().rect())
    generator = QSvgGenerator()
    generator.setFileName(str(path))
    generator.setSize(QSize(room.width(), room.height()))
    generator.setViewBox(room)
    generator.setTitle(plot.accessibleName())
    with _as_vectors(plot):
        painter = QPainter(generator)
        painter.fillRect(room, plot.backgroundBrush())
        plot.render(painter, QRectF(room), room)
        painter.end()


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
