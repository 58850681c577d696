"""The figures of a result, one below the other."""

from PySide6.QtCore import QByteArray, QSize
from PySide6.QtSvgWidgets import QSvgWidget
from PySide6.QtWidgets import QLabel, QScrollArea, QVBoxLayout, QWidget

from tumble.window.generic.drawn import Drawn, figures_of
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.work.presentation import Presentation

_WIDTH = 760


class FigureList(QScrollArea):
    """Heading, figure and caption of each, as in the report."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.figures: list[QSvgWidget] = []

    def show_presentation(self, presentation: Presentation) -> None:
        """Show another result."""
        content, self.figures = QWidget(), []
        column = QVBoxLayout(content)
        for drawn in figures_of(presentation):
            self._add(drawn, column)
        column.addStretch(1)
        self.setWidget(content)

    def _add(self, drawn: Drawn, column: QVBoxLayout) -> None:
        title, caption = QLabel(in_language(drawn.title)), PlainLabel(in_language(drawn.caption))
        title.setObjectName("heading")
        caption.setWordWrap(True)
        figure = QSvgWidget()
        figure.load(QByteArray(drawn.svg.encode()))
        size = figure.renderer().defaultSize()
        figure.setFixedSize(QSize(_WIDTH, round(_WIDTH * size.height() / max(size.width(), 1))))
        figure.setAccessibleName(title.text())
        self.figures.append(figure)
        for widget in (title, figure, caption):
            column.addWidget(widget)
