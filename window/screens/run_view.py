"""What a run looks like while it goes on, whichever its method."""

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from tumble.drivers.protocols import Block, PositionerStatus
from tumble.procedures.events import Event, PointCompleted, SamplesAcquired, StepStarted, WarningRaised
from tumble.procedures.plan import Plan
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Ask, Dwell, Point
from tumble.window.look.plots import Plot
from tumble.window.look.sentences import sentence_of
from tumble.window.registry import window_part
from tumble.window.widgets.dials import Dials
from tumble.window.widgets.run_log import RunLog
from tumble.window.widgets.run_plots import SamplesPlot, TemperaturePlot
from tumble.window.widgets.splitter import Splitter
from tumble.window.work.background import Background

_REDRAW_MS: Final = 50
_REFIT_MS: Final = 400


class RunView(QWidget):
    """Overview, dials or prompt, plots and log; drawn anew a few times a second, whatever the engine does."""

    confirmed = Signal()
    """What was asked for is set."""

    def __init__(self, background: Background, programme: Programme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._background = background
        self.points: list[Point] = []
        self._step: Dwell | None = None
        self._block: Block | None = None
        self._drawn = 0
        self.dials, self.log = Dials(), RunLog()
        self.temperature, self.samples = TemperaturePlot(), SamplesPlot()
        self._place = QStackedWidget()
        self._make_parts(programme)
        self._lay_out()
        self._redraw = QTimer(self, interval=_REDRAW_MS)
        self._redraw.timeout.connect(self._draw)
        self._refit = QTimer(self, interval=_REFIT_MS)
        self._refit.timeout.connect(self._analyse)
        self._redraw.start()
        self._refit.start()

    def begin(self, programme: Programme, plan: Plan, points: Sequence[Point] = ()) -> None:
        """Show a run that begins, or goes on after some points, by the method that its programme names."""
        self._take_parts_of(programme)
        self.points = list(points)
        dwells = [planned.step for planned in plan.steps if isinstance(planned.step, Dwell)]
        self.overview.show_plan(dwells, points)
        self.figures.begin(points)
        self._step, self._block = None, None
        self._drawn = -1
        self.samples.begin(programme.layout.channels)
        for plot in self.findChildren(Plot):
            plot.way_back.begin_anew()
        self.ask_nothing()
        self.log.clear()

    def hear(self, event: Event) -> None:
        """Show what happened."""
        match event:
            case StepStarted(step=Dwell() as dwell):
                self._step = dwell
                self.overview.begin(dwell)
            case SamplesAcquired(block=block):
                self._block = block
            case PointCompleted(point=point):
                self._complete(point)
        if sentence := sentence_of(event, self._part.words):
            self.log.say(sentence, warning=isinstance(event, WarningRaised))

    def see(self, name: str, status: PositionerStatus) -> None:
        """Show where a positioner is."""
        self.dials.show_status(name, status)
        self.prompt.see(name, status)

    def ask(self, ask: Ask) -> None:
        """Put what is to be set in the place of the dials."""
        self.prompt.ask(ask)
        self._place.setCurrentWidget(self.prompt)

    def ask_nothing(self) -> None:
        """Show the dials again."""
        self._place.setCurrentWidget(self.dials)

    @property
    def asks(self) -> bool:
        """Whether a condition is asked for."""
        return self._place.currentWidget() is self.prompt

    def _complete(self, point: Point) -> None:
        self.points.append(point)
        self.figures.add(point)
        if self._step is not None:
            self.overview.complete(self._step, point)

    def _make_parts(self, programme: Programme) -> None:
        layout, self._part = programme.layout, window_part(programme.method)
        self.prompt, self.overview = self._part.prompt(layout), self._part.overview(layout)
        self.figures = self._part.figures(layout, self._background)
        self.prompt.confirmed.connect(self.confirmed)
        self._place.addWidget(self.prompt)

    def _take_parts_of(self, programme: Programme) -> None:
        """Put the parts of another method in the places of those that are there."""
        if window_part(programme.method) is self._part:
            return
        prompt, overview, figures = self.prompt, self.overview, self.figures
        self._make_parts(programme)
        self._place.removeWidget(prompt)
        prompt.deleteLater()
        self._left.replace(overview, self.overview)
        self._right.replace(figures, self.figures)

    def _lay_out(self) -> None:
        self._place.insertWidget(0, self.dials)
        self.ask_nothing()
        self._left = Splitter(Qt.Orientation.Vertical, (self._place, self.overview), (3, 2))
        small = Splitter(Qt.Orientation.Horizontal, (self.temperature, self.samples), (1, 1))
        self._right = Splitter(Qt.Orientation.Vertical, (self.figures, small, self.log), (9, 4, 3))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(Splitter(Qt.Orientation.Horizontal, (self._left, self._right), (2, 3)))

    def _draw(self) -> None:
        """Draw the newest samples, and one of the plots that are not up to date: all at once would be felt."""
        if not self.isVisible():
            return
        if self._block is not None:
            self.samples.draw_block(self._block)
            self._block = None
        if len(self.points) != self._drawn:
            self._drawn = len(self.points)
            self.figures.draw_later(self._draw_temperature)
        self.figures.draw_next()

    def _analyse(self) -> None:
        self.figures.analyse()

    def _draw_temperature(self) -> None:
        self.temperature.draw_points(self.points)
