"""A report as PDF, without a browser: Qt lays out the page, its drawings go in as pictures."""

import re
from pathlib import Path
from typing import Final

from PySide6.QtCore import QByteArray, QMarginsF, QSizeF, QThread, QUrl
from PySide6.QtGui import QImage, QPageLayout, QPageSize, QPainter, QPdfWriter, QTextDocument
from PySide6.QtSvg import QSvgRenderer

from tumble.app.exits import Exit, JobError

_SVG: Final = re.compile(r"<svg .*?</svg>", re.DOTALL)
_MARGIN_MM: Final = 15.0
_DPI: Final = 200
_POINTS_PER_INCH: Final = 72.0


def print_page(html: str, path: Path) -> None:
    """Write a page of HTML as PDF on A4, and wait for it. Raises `JobError` where the file cannot be written."""
    printing = _Printing(html, path)
    printing.start()
    printing.wait()
    if printing.error is not None:
        raise printing.error
    if not path.is_file() or not path.stat().st_size:
        raise JobError(f"{path}: cannot be written; choose another place", Exit.STORAGE)


class _Printing(QThread):
    """A text document wants a thread that Qt has made."""

    def __init__(self, html: str, path: Path) -> None:
        super().__init__()
        self._html, self._path = html, path
        self.error: Exception | None = None
        """What went wrong, once it is over."""

    def run(self) -> None:
        """Lay out and write."""
        try:
            _print(self._html, self._path)
        except Exception as error:
            self.error = error


def _print(html: str, path: Path) -> None:
    writer = QPdfWriter(str(path))
    writer.setCreator("tumble")
    writer.setPageSize(QPageSize(QPageSize.PageSizeId.A4))
    writer.setPageMargins(QMarginsF(*[_MARGIN_MM] * 4), QPageLayout.Unit.Millimeter)
    writer.setResolution(_DPI)
    page = writer.pageLayout().paintRectPoints()
    document = QTextDocument()
    document.setPageSize(QSizeF(page.width(), page.height()))
    document.setHtml(_with_pictures(html, document, page.width()))
    document.print_(writer)


def _with_pictures(html: str, document: QTextDocument, width_pt: float) -> str:
    """Put a picture in the place of every drawing: a text document knows no SVG."""

    def picture(found: re.Match[str]) -> str:
        renderer = QSvgRenderer(QByteArray(found[0].encode()))
        natural = renderer.defaultSize()
        wide = min(natural.width(), width_pt)
        high = wide * natural.height() / max(natural.width(), 1)
        scale = _DPI / _POINTS_PER_INCH
        image = QImage(round(wide * scale), round(high * scale), QImage.Format.Format_RGB32)
        image.fill(0xFFFFFFFF)
        painter = QPainter(image)
        renderer.render(painter)
        painter.end()
        name = f"drawing-{found.start()}"
        document.addResource(QTextDocument.ResourceType.ImageResource, QUrl(name), image)
        return f'<img src="{name}" width="{wide:.0f}" height="{high:.0f}">'

    return _SVG.sub(picture, html)
