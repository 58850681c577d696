"""The figures of a result, one below the other: as plots where they can be, else as the pictures of the report."""

from PySide6.QtCore import QByteArray, QSize
from PySide6.QtSvgWidgets import QSvgWidget
from PySide6.QtWidgets import QGridLayout, QLabel, QScrollArea, QVBoxLayout, QWidget

from tumble.calibrations.report.layers import Sheet
from tumble.window.generic.drawn import Drawn, figures_of
from tumble.window.generic.panel_plot import panel_plots
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.work.presentation import Presentation

_WIDTH = 760


class FigureList(QScrollArea):
    """Heading, figure and caption of each."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.figures: list[QWidget] = []

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
        figure = _picture(drawn.svg) if drawn.sheet is None else _plots(drawn.sheet)
        figure.setAccessibleName(title.text())
        self.figures.append(figure)
        for widget in (title, figure, caption):
            column.addWidget(widget)


def _picture(svg: str) -> QWidget:
    """On white paper, as wide as the page of the report."""
    picture = QSvgWidget()
    picture.setStyleSheet("background: #FFFFFF;")
    picture.load(QByteArray(svg.encode()))
    size = picture.renderer().defaultSize()
    picture.setFixedSize(QSize(_WIDTH, round(_WIDTH * size.height() / max(size.width(), 1))))
    return picture


def _plots(sheet: Sheet) -> QWidget:
    """Beside and below each other as in the report, and as high for their width."""
    plots = QWidget()
    grid = QGridLayout(plots)
    grid.setContentsMargins(0, 0, 0, 0)
    for number, plot in enumerate(panel_plots(sheet)):
        plot.setMinimumHeight(round(_WIDTH * sheet.height / sheet.width))
        grid.addWidget(plot, *divmod(number, sheet.columns))
    return plots
