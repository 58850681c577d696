"""Plots of a result: the fit, and the residual against what one likes."""

from collections.abc import Mapping

import pyqtgraph as pg
from PySide6.QtWidgets import QComboBox, QFormLayout, QVBoxLayout, QWidget

from tumble.window.look.language import tr
from tumble.window.methods.dividing_head.presenting import Rows, models_of
from tumble.window.methods.dividing_head.run_plots import AnglePlot, OutputPlot
from tumble.window.widgets.folding_row import FoldingRow
from tumble.window.work.presentation import Presentation


class FitPlot(OutputPlot):
    """The rows of a result with the model through every mount."""

    def show_presentation(self, presentation: Presentation) -> None:
        """Draw the rows of the declared model."""
        rows = models_of(presentation)["declared"]
        self.way_back.home()
        self.draw_curves(rows.curves)
        self.draw(rows.mounts, rows.abscissae["angle"], rows.output_v)


class ResidualFigure(QWidget):
    """Residual of either model against angle, time, temperature or realisation; the band is one dwell."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.model, self.against = QComboBox(), QComboBox()
        self.plot = AnglePlot(left=tr("residual (µV)"))
        self._band = pg.LinearRegionItem((0, 0), orientation="horizontal", movable=False)
        self._band.setZValue(-10)
        self.plot.addItem(self._band)
        self._models: Mapping[str, Rows] = {}
        choice = FoldingRow((_choice(tr("&Model"), self.model), _choice(tr("A&gainst"), self.against)))
        layout = QVBoxLayout(self)
        layout.addWidget(choice)
        layout.addWidget(self.plot, stretch=1)
        self.model.currentIndexChanged.connect(self._draw)
        self.against.currentIndexChanged.connect(self._draw)
        self.plot.recoloured.connect(self._recolour)
        self._recolour()

    def show_presentation(self, presentation: Presentation) -> None:
        """Show another result."""
        self._models = {}
        self.model.clear()
        self.against.clear()
        models, names = (
            models_of(presentation),
            {"declared": tr("declared model"), "augmented": tr("with what was found")},
        )
        for name in models:
            self.model.addItem(names[name], name)
        for name in models["declared"].abscissae:
            if name != "angle":
                self.against.addItem(self._label(name), name)
        self._models = models
        self._draw()

    def _label(self, name: str) -> str:
        return {
            "turn": tr("head angle within the turn (°)"),
            "time": tr("time (min)"),
            "temperature": tr("temperature (°C)"),
            "realisation": tr("realisation"),
        }[name]

    def _draw(self) -> None:
        if not self._models or self.model.currentData() is None or self.against.currentData() is None:
            return
        rows = self._models[self.model.currentData()]
        name = self.against.currentData()
        self.plot.name_axes(self._label(name), tr("residual (µV)"))
        self._band.setRegion((-rows.scatter_uv, rows.scatter_uv))
        self.plot.forget_key()
        self.plot.way_back.home()
        self.plot.draw(rows.mounts, rows.abscissae[name], rows.residual_uv)

    def _recolour(self) -> None:
        self._band.setBrush(self.plot.band)
        for line in self._band.lines:
            line.setPen(self.plot.pen(self.plot.colours.grid, 1))


def _choice(title: str, box: QComboBox) -> QWidget:
    """A choice with its title before it."""
    titled = QWidget()
    form = QFormLayout(titled)
    form.setContentsMargins(0, 0, 0, 0)
    form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.FieldsStayAtSizeHint)
    form.addRow(title, box)
    return titled
