"""What a run looks like while it goes on."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from tumble.drivers.protocols import Block, PositionerStatus
from tumble.procedures.events import Event, PointCompleted, SamplesAcquired, StepStarted, WarningRaised
from tumble.procedures.methods.dividing_head.rows import Row, row_of
from tumble.procedures.plan import Plan
from tumble.procedures.steps import Dwell, Point
from tumble.window.look.sentences import sentence_of
from tumble.window.widgets.dial import Dial
from tumble.window.widgets.pose_map import PoseMap
from tumble.window.widgets.prompts import MountPrompt
from tumble.window.widgets.run_log import RunLog
from tumble.window.widgets.run_plots import OutputPlot, ResidualPlot, SamplesPlot, TemperaturePlot
from tumble.window.widgets.splitter import Splitter
from tumble.window.work.background import Background
from tumble.window.work.live_fit import LiveFit, fit_live

_REDRAW_MS: Final = 50
_REFIT_MS: Final = 400


class RunView(QWidget):
    """Map of poses, dial or mount prompt, plots and log; drawn anew a few times a second, whatever the engine does."""

    def __init__(self, background: Background, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._background = background
        self.points: list[Row] = []
        self._step: Dwell | None = None
        self._block: Block | None = None
        self._drawn = self._fitted = 0
        self._fitting = False
        self._stale: dict[Callable[[], None], None] = {}
        """What is to be drawn anew, in order."""
        self.fit: LiveFit | None = None
        self.dial, self.mount_prompt, self.map, self.log = Dial(), MountPrompt(), PoseMap(), RunLog()
        self.output, self.residual = OutputPlot(), ResidualPlot()
        self.temperature, self.samples = TemperaturePlot(), SamplesPlot()
        self._place = QStackedWidget()
        self._lay_out()
        self._redraw = QTimer(self, interval=_REDRAW_MS)
        self._redraw.timeout.connect(self._draw)
        self._refit = QTimer(self, interval=_REFIT_MS)
        self._refit.timeout.connect(self._fit)
        self._redraw.start()
        self._refit.start()

    def begin(self, plan: Plan, points: Sequence[Point] = ()) -> None:
        """Show a run that begins, or goes on after some points."""
        self.points = [row_of(point) for point in points]
        dwells = [planned.step for planned in plan.steps if isinstance(planned.step, Dwell)]
        self.map.show_plan(dwells, done=len(self.points))
        self._step, self._block, self.fit = None, None, None
        self._drawn, self._fitted = -1, 0
        self._show_fit(None)
        self.samples.forget()
        self.ask_nothing()
        self.log.clear()

    def hear(self, event: Event) -> None:
        """Show what happened."""
        match event:
            case StepStarted(step=Dwell() as dwell):
                self._step = dwell
                self.map.begin(dwell)
            case SamplesAcquired(block=block):
                self._block = block
            case PointCompleted(point=point):
                self.points.append(row_of(point))
                if self._step is not None:
                    self.map.complete(self._step)
        if sentence := sentence_of(event):
            self.log.say(sentence, warning=isinstance(event, WarningRaised))

    def see(self, status: PositionerStatus | None) -> None:
        """Show where the head is; None where nobody knows."""
        self.dial.show_status(status)

    def ask_mount(self, mount: str) -> None:
        """Put the picture of a mount in the place of the dial."""
        self.mount_prompt.ask(mount)
        self._place.setCurrentWidget(self.mount_prompt)

    def ask_nothing(self) -> None:
        """Show the dial again."""
        self._place.setCurrentWidget(self.dial)

    @property
    def asks_mount(self) -> bool:
        """Whether a mount is asked for."""
        return self._place.currentWidget() is self.mount_prompt

    def _lay_out(self) -> None:
        for part in (self.dial, self.mount_prompt):
            self._place.addWidget(part)
        left = Splitter(Qt.Orientation.Vertical, (self._place, self.map), (3, 2))
        small = Splitter(Qt.Orientation.Horizontal, (self.temperature, self.samples), (1, 1))
        right = Splitter(Qt.Orientation.Vertical, (self.output, self.residual, small, self.log), (5, 4, 4, 3))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(Splitter(Qt.Orientation.Horizontal, (left, right), (2, 3)))

    def _draw(self) -> None:
        """Draw the newest samples, and one of the plots that are not up to date: all at once would be felt."""
        if not self.isVisible():
            return
        if self._block is not None:
            self.samples.draw_block(self._block)
            self._block = None
        if len(self.points) != self._drawn:
            self._drawn = len(self.points)
            self._stale |= {self._draw_output: None, self._draw_temperature: None}
        if self._stale:
            draw = next(iter(self._stale))
            del self._stale[draw]
            draw()

    def _draw_output(self) -> None:
        self.output.draw_points(self.points, np.array([_volts(point) for point in self.points]))

    def _draw_temperature(self) -> None:
        self.temperature.draw_points(self.points)

    def _draw_curves(self) -> None:
        self.output.draw_curves(self.fit.curves if self.fit else {})

    def _draw_residual(self) -> None:
        self.residual.draw_fit(self.points, self.fit)

    def _fit(self) -> None:
        if self._fitting or len(self.points) == self._fitted:
            return
        points = tuple(self.points)
        self._fitting, self._fitted = True, len(points)
        self._background.start(lambda: fit_live(points), self._show_fit, self._without_fit)

    def _show_fit(self, fit: LiveFit | None) -> None:
        self._fitting = False
        if fit is not None and fit.points > len(self.points):
            return  # another run has begun meanwhile
        self.fit = fit
        self._stale |= {self._draw_residual: None, self._draw_curves: None}

    def _without_fit(self, error: Exception) -> None:
        """Points from which nothing can be fitted yet: the analysis after the run says why. Other errors are told."""
        self._show_fit(None)
        if not isinstance(error, ValueError | ArithmeticError):
            self._background.failed.emit(error)


def _volts(row: Row) -> float:
    return row.voltage_v if abs(row.voltage_v) < 1e30 else float("nan")
