"""Pages of the handbook, read in the window."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from PySide6.QtCore import QEvent, QUrl
from PySide6.QtGui import QImage, QImageReader, QResizeEvent, QTextCursor, QTextDocument, QTextFragment
from PySide6.QtWidgets import QTextBrowser, QWidget

from tumble.window.look.language import tr

_PICTURE_SHARE: Final = 0.42
"""Width of a picture in that of the page, at most: many stand in a table beside words."""


class PageReader(QTextBrowser):
    """Markdown with pictures and links between pages; what leads elsewhere is left to the desktop."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._page = QUrl()
        self.setOpenExternalLinks(True)
        self.setAccessibleName(tr("Page of the handbook"))
        self.sourceChanged.connect(lambda _: self._fit_pictures())

    def open_page(self, path: Path) -> None:
        """Show a page from its beginning."""
        self.setSource(QUrl.fromLocalFile(str(path)), QTextDocument.ResourceType.MarkdownResource)

    def doSetSource(  # noqa: N802  # Qt's name
        self,
        name: QUrl | str,
        type: QTextDocument.ResourceType = QTextDocument.ResourceType.UnknownResource,  # noqa: A002
    ) -> None:
        """Go where a link leads, if there is a page."""
        wanted = self.source().resolved(QUrl(name))
        path = Path(wanted.toLocalFile())
        if path.suffix == ".md" and path.is_file():
            self._page = wanted
            super().doSetSource(wanted, QTextDocument.ResourceType.MarkdownResource)
        elif wanted.isEmpty():
            super().doSetSource(wanted, type)

    def loadResource(self, type: int, name: QUrl | str) -> object:  # noqa: N802, A002  # Qt's names
        """Pictures by where the page lies, which Qt knows only once it has shown it."""
        if type != QTextDocument.ResourceType.ImageResource.value:
            return super().loadResource(type, name)
        return QImage(self._file(QUrl(name)))

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """Keep pictures as wide as their share."""
        super().resizeEvent(event)
        self._fit_pictures()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette: links keep the colour that they were read in."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.source().isValid():
            self.reload()

    def _fit_pictures(self) -> None:
        room = round(_PICTURE_SHARE * self.viewport().width())
        for picture in list(self._pictures()):
            kind = picture.charFormat().toImageFormat()
            natural = QImageReader(self._file(QUrl(kind.name()))).size().width()
            kind.setWidth(min(natural, room))
            cursor = QTextCursor(self.document())
            cursor.setPosition(picture.position())
            cursor.setPosition(picture.position() + picture.length(), QTextCursor.MoveMode.KeepAnchor)
            cursor.setCharFormat(kind)

    def _file(self, name: QUrl) -> str:
        return self._page.resolved(name).toLocalFile()

    def _pictures(self) -> Iterator[QTextFragment]:
        block = self.document().begin()
        while block.isValid():
            parts = block.begin()
            while not parts.atEnd():
                if parts.fragment().charFormat().isImageFormat():
                    yield parts.fragment()
                parts += 1
            block = block.next()
