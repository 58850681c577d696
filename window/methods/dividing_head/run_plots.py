"""What a run measures, while it does: output and residual against head angle."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QWidget

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.window.look.language import tr
from tumble.window.methods.dividing_head.live_fit import LiveFit
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.widgets.series_plot import SeriesPlot

_MICRO: Final = 1e6
_RING: Final = 2.4
"""Width of a ring around a mark, of that of the mark."""


class AnglePlot(SeriesPlot):
    """Something of every point against the head angle, in the colour and shape of its mount."""

    def __init__(self, left: str, parent: QWidget | None = None) -> None:
        super().__init__(tuple(MOUNTS), bottom=tr("head angle (°)"), left=left, parent=parent)
        self._align()
        self.recoloured.connect(self._align)

    def draw_points(self, points: Sequence[Row], values: FloatArray) -> None:
        """Draw a value of every point."""
        self.draw([point.mount for point in points], np.array([point.angle_deg for point in points]), values)

    def title_of(self, name: str) -> str:
        """The name of the mount."""
        return mount_name(name)

    def draw(self, mounts: Sequence[str], abscissa: FloatArray, values: FloatArray) -> None:
        """Draw a value of every row against another."""
        of = np.array(mounts)
        self.draw_series({mount: (abscissa[of == mount], values[of == mount]) for mount in dict.fromkeys(mounts)})

    def _align(self) -> None:
        """Give the ordinate the width of any number, so that plots above each other line up."""
        self.getAxis("left").setWidth(self.fontMetrics().horizontalAdvance("-0000.000"))


class OutputPlot(AnglePlot):
    """Output against angle, with the model through every mount."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(left=tr("output (V)"), parent=parent)
        self._curves: dict[str, pg.PlotDataItem] = {}
        self._expected = pg.PlotCurveItem()  # it is not seen, and only has a place
        self.addItem(self._expected)
        self.recoloured.connect(self._recolour_curves)

    def expect_angles(self, angles_deg: Sequence[float]) -> None:
        """Have an axis that holds all of these head angles, whatever is drawn."""
        self._expected.setData(np.array(angles_deg), np.full(len(angles_deg), np.nan))

    def draw_curves(self, curves: Mapping[str, tuple[FloatArray, FloatArray]]) -> None:
        """Draw head angle and model output by mount."""
        for mount in set(self._curves) - set(curves):
            self.removeItem(self._curves.pop(mount))
        for mount, curve in curves.items():
            if mount not in self._curves:
                self._curves[mount] = self.plot([], [], name=tr("{mount}, model", mount=mount_name(mount)))
                self._curves[mount].setZValue(-1)
                self._recolour_curves()
            self._curves[mount].setData(*curve)

    def _recolour_curves(self) -> None:
        for curve in self._curves.values():
            curve.setPen(self.pen(self.colours.pale, 1.2))


class ResidualPlot(AnglePlot):
    """Residual under the output: what is far outside of the band is a gross error, and is ringed."""

    def __init__(self, above: OutputPlot, parent: QWidget | None = None) -> None:
        super().__init__(left=tr("residual (µV)"), parent=parent)
        self.setXLink(above)
        self._band = pg.LinearRegionItem((0, 0), orientation="horizontal", movable=False)
        self._rings = pg.ScatterPlotItem(brush=None)
        self._band.setZValue(-10)
        self.addItem(self._band)
        self.addItem(self._rings)
        self._recolour_marks()
        self.recoloured.connect(self._recolour_marks)

    @property
    def ringed(self) -> int:
        """How many gross errors are shown."""
        return len(self._rings.data)

    def draw_fit(self, points: Sequence[Row], fit: LiveFit | None) -> None:
        """Draw the residuals of the points that were fitted."""
        if fit is None:
            self.draw_points((), np.empty(0))
            self._rings.clear()
            self._band.setRegion((0, 0))
            return
        residual_uv, fitted = fit.residual_v * _MICRO, points[: fit.points]
        self.draw_points(fitted, residual_uv)
        scatter_uv = fit.scatter_v * _MICRO
        self._band.setRegion((-2 * scatter_uv, 2 * scatter_uv))
        self._rings.setData([fitted[index].angle_deg for index in fit.gross], residual_uv[list(fit.gross)])

    def _recolour_marks(self) -> None:
        self._band.setBrush(self.band)
        for line in self._band.lines:
            line.setPen(self.pen(self.colours.grid, 1))
        self._rings.setPen(self.pen(self.colours.bad, 2.5))
        self._rings.setSize(_RING * self.mark_px)
