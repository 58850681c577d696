"""Pages of the handbook, read in the window."""

from pathlib import Path
from typing import Final

from PySide6.QtCore import QEvent, Qt, QUrl
from PySide6.QtGui import QImage, QTextDocument
from PySide6.QtWidgets import QTextBrowser, QWidget

from tumble.window.look.language import tr

_PICTURE_SHARE: Final = 0.42
"""Width of a picture in that of the page, at most: many stand in a table beside words."""


class PageReader(QTextBrowser):
    """Markdown with pictures and links between pages; what leads elsewhere is left to the desktop."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setOpenExternalLinks(True)
        self.setAccessibleName(tr("Page of the handbook"))

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
            super().doSetSource(wanted, QTextDocument.ResourceType.MarkdownResource)
        elif wanted.isEmpty():
            super().doSetSource(wanted, type)

    def loadResource(self, type: int, name: QUrl | str) -> object:  # noqa: N802, A002  # Qt's names
        """Pictures no wider than their share of the page."""
        if type != QTextDocument.ResourceType.ImageResource.value:
            return super().loadResource(type, name)
        image = QImage(self.source().resolved(QUrl(name)).toLocalFile())
        room = round(_PICTURE_SHARE * self.viewport().width())
        return image if image.width() <= room else image.scaledToWidth(room, Qt.TransformationMode.SmoothTransformation)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Take over another palette: links keep the colour that they were read in."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.source().isValid():
            self.reload()
