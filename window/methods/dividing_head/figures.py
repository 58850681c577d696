"""Output and residual of a run while it goes on, with the model through the points so far."""

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout

from tumble.procedures.layout import Layout
from tumble.procedures.methods.dividing_head.layout import HEAD
from tumble.procedures.methods.dividing_head.rows import Row, row_of
from tumble.procedures.steps import Dwell, Point
from tumble.window.methods.dividing_head.live_fit import LiveFit, fit_live
from tumble.window.methods.dividing_head.run_plots import OutputPlot, ResidualPlot
from tumble.window.parts import Figures
from tumble.window.widgets.splitter import Splitter
from tumble.window.work.background import Background


class HeadFigures(Figures):
    """One above the other against the head angle; fitted anew in the background as points come."""

    def __init__(self, _: Layout, background: Background) -> None:
        super().__init__()
        self._background = background
        self.points: list[Row] = []
        self.fit: LiveFit | None = None
        self._fitted, self._fitting = 0, False
        self.output = OutputPlot()
        self.residual = ResidualPlot(self.output)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(Splitter(Qt.Orientation.Vertical, (self.output, self.residual), (1, 1)))

    def expect(self, dwells: Sequence[Dwell]) -> None:
        """Have the axes of head angle as long as the programme from the start, so that they stand still."""
        self.output.expect_angles([dwell.targets_deg[HEAD] for dwell in dwells])

    def begin(self, points: Sequence[Point]) -> None:
        """Show a run that begins, or goes on after some points."""
        self.points, self._fitted = [row_of(point) for point in points], 0
        self.draw_later(self._draw_output)
        self._show_fit(None)

    def add(self, point: Point) -> None:
        """Show a further point."""
        self.points.append(row_of(point))
        self.draw_later(self._draw_output)

    def analyse(self) -> None:
        """Fit the points so far, unless that was done or is under way."""
        if self._fitting or len(self.points) == self._fitted:
            return
        points = tuple(self.points)
        self._fitting, self._fitted = True, len(points)
        self._background.start(lambda: fit_live(points), self._show_fit, self._without_fit)

    def _draw_output(self) -> None:
        self.output.draw_points(self.points, np.array([_volts(point) for point in self.points]))

    def _draw_curves(self) -> None:
        self.output.draw_curves(self.fit.curves if self.fit else {})

    def _draw_residual(self) -> None:
        self.residual.draw_fit(self.points, self.fit)

    def _show_fit(self, fit: LiveFit | None) -> None:
        self._fitting = False
        if fit is not None and fit.points > len(self.points):
            return  # another run has begun meanwhile
        self.fit = fit
        self.draw_later(self._draw_residual, self._draw_curves)

    def _without_fit(self, error: Exception) -> None:
        """Points from which nothing can be fitted yet: the analysis after the run says why. Other errors are told."""
        self._show_fit(None)
        if not isinstance(error, ValueError | ArithmeticError):
            self._background.failed.emit(error)


def _volts(row: Row) -> float:
    return row.voltage_v if abs(row.voltage_v) < 1e30 else float("nan")
