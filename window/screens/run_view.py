"""What a run looks like while it goes on, whichever its method."""

from collections.abc import Mapping, Sequence
from typing import Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QTabWidget, QVBoxLayout, QWidget

from tumble.app.running import Job
from tumble.drivers.protocols import Block, PositionerStatus
from tumble.procedures.events import (
    Event,
    PointCompleted,
    RetakeBegun,
    SamplesAcquired,
    StepStarted,
    WarningRaised,
)
from tumble.procedures.plan import Plan
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Ask, Dwell, Point, Step
from tumble.window.look.language import tr
from tumble.window.look.plots import Plot
from tumble.window.look.sentences import sentence_of, unit_text
from tumble.window.registry import window_part
from tumble.window.widgets.dials import Dials
from tumble.window.widgets.prompts import ReadingPrompt, UnitPrompt
from tumble.window.widgets.run_log import RunLog
from tumble.window.widgets.run_plots import SamplesPlot, TemperaturePlot
from tumble.window.widgets.splitter import Splitter
from tumble.window.widgets.step_list import StepList
from tumble.window.work.background import Background

_REDRAW_MS: Final = 50
_REFIT_MS: Final = 400


class RunView(QWidget):
    """Overview, dials, plots and tabs, drawn anew a few times a second; or, in their place, what is asked for."""

    confirmed = Signal()
    """What was asked for is set."""
    unit_confirmed = Signal()
    """The unit that was asked for is on the stand."""

    def __init__(self, background: Background, programme: Programme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._background = background
        self.points: list[Point] = []
        self._dwells: list[Dwell] = []
        self._step: Dwell | None = None
        self._repeating = False
        """Whether the last point is taken again, which is no further step."""
        self._block: Block | None = None
        self._drawn = 0
        self.dials, self.log, self.steps = Dials(), RunLog(), StepList()
        self.temperature, self.samples = TemperaturePlot(), SamplesPlot()
        self.reading, self.unit, self.tabs = ReadingPrompt(), UnitPrompt(), QTabWidget()
        self._make_parts(programme)
        self._lay_out()
        self.unit.confirm.clicked.connect(self.unit_confirmed)
        self._redraw = QTimer(self, interval=_REDRAW_MS)
        self._redraw.timeout.connect(self._draw)
        self._refit = QTimer(self, interval=_REFIT_MS)
        self._refit.timeout.connect(self._analyse)
        self._redraw.start()
        self._refit.start()

    def begin(self, job: Job, plan: Plan, points: Sequence[Point] = ()) -> None:
        """Show a run that begins, or goes on after some points, by the method that its programme names."""
        programme = job.programme
        self._take_parts_of(programme)
        for page in (self.prompt, self.reading):
            page.show_unit(unit_text(job.serial_number, job.lot))
        self.points = list(points)
        self._dwells = [planned.step for planned in plan.steps if isinstance(planned.step, Dwell)]
        self.overview.show_plan(self._dwells, points)
        self.steps.show_steps(plan.steps, len(points))
        self.figures.expect(self._dwells)
        self.figures.begin(points)
        self._step, self._block, self._repeating = None, None, False
        self._drawn = -1
        self.samples.begin(programme.layout.channels)
        for plot in self.findChildren(Plot):
            plot.begin_anew()
        self.ask_nothing()
        self.log.clear()

    def hear(self, event: Event) -> None:
        """Show what happened."""
        match event:
            case RetakeBegun():
                self._repeating = True
            case StepStarted(step=step):
                self._begin_step(step)
            case SamplesAcquired(block=block):
                self._block = block
            case PointCompleted(point=point) if self._repeating:
                self._replace(point)
            case PointCompleted(point=point):
                self._complete(point)
        if sentence := sentence_of(event, self._part.words):
            self.log.say(sentence, warning=isinstance(event, WarningRaised))

    def see(self, name: str, status: PositionerStatus) -> None:
        """Show where a positioner is."""
        self.dials.show_status(name, status)
        self.prompt.see(name, status)

    def see_all(self, statuses: Mapping[str, PositionerStatus]) -> None:
        """Show where all positioners are."""
        for name, status in statuses.items():
            self.see(name, status)

    def forget_positions(self, names: Sequence[str]) -> None:
        """Show the positioners of a stand, of which nobody knows where they are."""
        self.dials.show_positioners(names)
        self.prompt.forget()

    def ask(self, ask: Ask) -> None:
        """Ask for a condition, in the place of everything else."""
        self.prompt.ask(ask)
        self._show_page(self.prompt)

    def ask_reading(self, setting_deg: float, prompt: str) -> None:
        """Ask for a reading of the head."""
        self._show_page(self.reading)
        self.reading.ask(setting_deg, prompt)

    def ask_unit(self, unit: str) -> None:
        """Ask for a unit, by the text that says which it is."""
        self.unit.ask(unit)
        self._show_page(self.unit)

    def ask_nothing(self) -> None:
        """Show what goes on."""
        self._show_page(self._work)

    @property
    def asks(self) -> bool:
        """Whether a condition is asked for."""
        return not self.prompt.isHidden()

    def _show_page(self, shown: QWidget) -> None:
        """One page is there at a time, and only that one needs room."""
        for page in (self._work, self.prompt, self.reading, self.unit):
            if page is not shown:
                page.hide()
        shown.show()

    def _begin_step(self, step: Step) -> None:
        if not self._repeating:
            self.steps.begin(step)
        if isinstance(step, Dwell):
            self._step = step
            self.overview.begin(step)

    def _complete(self, point: Point) -> None:
        self.points.append(point)
        self.figures.add(point)
        self.steps.complete()
        if self._step is not None:
            self.overview.complete(self._step, point)

    def _replace(self, point: Point) -> None:
        """Show what the last point gave when it was taken again, in the place of what it gave before."""
        self._repeating = False
        self.points[-1] = point
        self.overview.show_plan(self._dwells, self.points)
        self.figures.begin(self.points)
        self._drawn = -1

    def _make_parts(self, programme: Programme) -> None:
        layout, self._part = programme.layout, window_part(programme.method)
        self.prompt, self.overview = self._part.prompt(layout), self._part.overview(layout)
        self.figures = self._part.figures(layout, self._background)
        self.prompt.confirmed.connect(self.confirmed)
        self.prompt.hide()

    def _take_parts_of(self, programme: Programme) -> None:
        """Put the parts of another method in the places of those that are there."""
        if window_part(programme.method) is self._part:
            return
        prompt, overview, figures = self.prompt, self.overview, self.figures
        self._make_parts(programme)
        self._pages.replaceWidget(prompt, self.prompt)
        prompt.hide()
        prompt.deleteLater()
        self._left.replace(overview, self.overview)
        self._right.replace(figures, self.figures)

    def _lay_out(self) -> None:
        for part, title in (
            (self.log, tr("Log")),
            (self.steps, tr("Steps")),
            (self.temperature, tr("Temperature")),
            (self.samples, tr("Samples")),
        ):
            self.tabs.addTab(part, title)
        self._left = Splitter(Qt.Orientation.Vertical, (self.dials, self.overview), (3, 2))
        self._right = Splitter(Qt.Orientation.Vertical, (self.figures, self.tabs), (9, 5))
        self._work = Splitter(Qt.Orientation.Horizontal, (self._left, self._right), (2, 3))
        self._pages = QVBoxLayout(self)
        self._pages.setContentsMargins(0, 0, 0, 0)
        for page in (self._work, self.prompt, self.reading, self.unit):
            self._pages.addWidget(page)
        self.ask_nothing()

    def _draw(self) -> None:
        """Draw one of the plots that are not up to date, or else the newest samples: all at once would be felt."""
        if not self.isVisible():
            return
        if len(self.points) != self._drawn:
            self._drawn = len(self.points)
            self.figures.draw_later(self._draw_temperature)
        if self.figures.draw_next() or self._block is None or not self.samples.isVisible():
            return
        self.samples.draw_block(self._block)
        self._block = None

    def _analyse(self) -> None:
        self.figures.analyse()

    def _draw_temperature(self) -> None:
        self.temperature.draw_points(self.points)
