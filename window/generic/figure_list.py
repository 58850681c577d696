"""The figures of a result, one below the other: as plots where they can be, else as the pictures of the report."""

from collections.abc import Sequence

from PySide6.QtCore import QByteArray, QSize
from PySide6.QtSvgWidgets import QSvgWidget
from PySide6.QtWidgets import QGridLayout, QLabel, QScrollArea, QVBoxLayout, QWidget

from tumble.calibrations.report.layers import Sheet
from tumble.window.generic.drawn import figures_of
from tumble.window.generic.panel_plot import panel_plots
from tumble.window.look.plain import PlainLabel
from tumble.window.look.plots import Plot
from tumble.window.look.sentences import in_language
from tumble.window.work.presentation import Drawn, Presentation

_WIDTH = 760


class FigureList(QScrollArea):
    """All of them, to be scrolled."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.figures: Sequence[QWidget] = ()

    def show_presentation(self, presentation: Presentation) -> None:
        """Show another result."""
        column = FigureColumn()
        column.show_figures(figures_of(presentation))
        self.figures = column.figures
        self.setWidget(column)


class FigureColumn(QWidget):
    """Heading, where there is one, figure and caption of each."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.figures: list[QWidget] = []
        self._parts: list[QWidget] = []
        self._column = QVBoxLayout(self)
        self._column.addStretch(1)

    def show_figures(self, figures: Sequence[Drawn]) -> None:
        """Show other figures."""
        for part in self._parts:
            self._column.removeWidget(part)
            part.deleteLater()
        self._parts, self.figures = [], []
        for drawn in figures:
            self._add(drawn)

    def _add(self, drawn: Drawn) -> None:
        title, caption = QLabel(in_language(drawn.title)), PlainLabel(in_language(drawn.caption))
        title.setObjectName("heading")
        title.setVisible(bool(drawn.title))
        caption.setWordWrap(True)
        figure = figure_of(drawn)
        if drawn.sheet is not None:
            for plot in figure.findChildren(Plot):
                plot.setMinimumHeight(round(_WIDTH * drawn.sheet.height / drawn.sheet.width))
        self.figures.append(figure)
        for part in (title, figure, caption):
            self._parts.append(part)
            self._column.insertWidget(self._column.count() - 1, part)


def figure_of(drawn: Drawn) -> QWidget:
    """A figure as plots where it can be, else as the picture of the report."""
    figure = _picture(drawn.svg) if drawn.sheet is None else _plots(drawn.sheet)
    figure.setAccessibleName(in_language(drawn.title or drawn.caption))
    return figure


def _picture(svg: str) -> QWidget:
    """On white paper, as wide as the page of the report."""
    picture = QSvgWidget()
    picture.setStyleSheet("background: #FFFFFF;")
    picture.load(QByteArray(svg.encode()))
    size = picture.renderer().defaultSize()
    picture.setFixedSize(QSize(_WIDTH, round(_WIDTH * size.height() / max(size.width(), 1))))
    return picture


def _plots(sheet: Sheet) -> QWidget:
    """Beside and below each other as in the report."""
    plots = QWidget()
    grid = QGridLayout(plots)
    grid.setContentsMargins(0, 0, 0, 0)
    for number, plot in enumerate(panel_plots(sheet)):
        grid.addWidget(plot, *divmod(number, sheet.columns))
    return plots
