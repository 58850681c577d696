"""The closed loop: what was found, the next experiment, before and after in numbers and pictures, what is left open."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QLabel, QListWidget, QScrollArea, QSizePolicy, QVBoxLayout, QWidget

from tumble.calibrations.core.sentences import series
from tumble.window.generic.figure_list import FigureColumn
from tumble.window.look.language import tr
from tumble.window.look.names import effect_name
from tumble.window.look.numbers import local, minutes
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.folding_row import buttons_at_left
from tumble.window.widgets.motion_button import MotionButton
from tumble.window.widgets.table import Table
from tumble.window.work.presentation import LoopSummary

if TYPE_CHECKING:
    from tumble.calibrations.tracing.experiments import Experiment
    from tumble.calibrations.tracing.sentences import Finding


class LoopView(QScrollArea):
    """One part below the other, those that have nothing to say left out; what to do next is before what it was for."""

    experiment_wanted = Signal(str)
    """Name of the programme."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._experiments: tuple[Experiment, ...] = ()
        self._allowed = True
        self.headline = _wrapped()
        self.findings = Table(
            (
                tr("effect"),
                tr("or"),
                tr("belongs to"),
                tr("coefficients (standard uncertainty)"),
                tr("p"),
            )
        )
        self.comparisons = Table(("", tr("declared model"), tr("with what was found"), tr("change")))
        self.figures, self.not_identifiable = FigureColumn(), _wrapped()
        self.experiments = QListWidget()
        self.experiments.setWordWrap(True)
        self.experiments.setSizeAdjustPolicy(QListWidget.SizeAdjustPolicy.AdjustToContents)
        self.experiments.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Maximum)
        self.run_button = MotionButton(tr("Run the chosen experiment"), "F5")
        self.run_button.clicked.connect(self._run)
        self.experiments.currentRowChanged.connect(self._refresh)
        self._titles = {
            self.findings: QLabel(tr("What was found")),
            self.experiments: QLabel(tr("What to measure next")),
            self.comparisons: QLabel(tr("Before and after")),
        }
        self._lay_out()

    def _lay_out(self) -> None:
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.addWidget(self.headline)
        for part, title in self._titles.items():
            title.setObjectName("heading")
            layout.addWidget(title)
            layout.addWidget(part)
            if part is self.experiments:
                layout.addWidget(buttons_at_left((self.run_button,)))
        layout.addWidget(self.figures)
        layout.addWidget(self.not_identifiable)
        layout.addStretch(1)
        self.setWidget(page)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)

    def show_loop(self, loop: LoopSummary) -> None:
        """Show that of another result."""
        self._experiments = tuple(loop.experiments)
        self.headline.setText(in_language(loop.headline))
        self.findings.fill([_line_of(found) for found in loop.findings])
        self.comparisons.fill([tuple(map(in_language, line)) for line in loop.comparisons])
        self.figures.show_figures(loop.figures)
        self.figures.setVisible(bool(loop.figures))
        self.findings.show_whole()
        self.comparisons.show_whole()
        self.not_identifiable.setText(local("\n".join(_reservations(loop))))
        self._list_experiments(self._experiments)
        shown = {
            self.findings: bool(loop.findings),
            self.comparisons: bool(loop.comparisons),
            self.experiments: bool(self._experiments),
        }
        for part, title in self._titles.items():
            part.setVisible(shown[part])
            title.setVisible(shown[part])
        self.run_button.setVisible(bool(self._experiments))

    def allow_runs(self, allowed: bool) -> None:
        """Whether the stand is free."""
        self._allowed = allowed
        self._refresh()

    def _list_experiments(self, experiments: "Sequence[Experiment]") -> None:
        self.experiments.clear()
        for experiment in experiments:
            title = tr("no programme helps")
            if experiment.programme:
                title = f"{experiment.programme} ({minutes(experiment.stand_time_s)})"
            self.experiments.addItem(f"{title}: {in_language(experiment.why)}")
        self.experiments.setCurrentRow(0 if experiments else -1)
        self._refresh()

    def _chosen(self) -> str:
        row = self.experiments.currentRow()
        return self._experiments[row].programme if 0 <= row < len(self._experiments) else ""

    def _refresh(self) -> None:
        row = self.experiments.currentRow()
        if chosen := self._chosen():
            time = minutes(self._experiments[row].stand_time_s)
            self.run_button.entitle(tr("Run {programme}, about {time}", programme=chosen, time=time))
        self.run_button.setEnabled(self._allowed and bool(self._chosen()))

    def _run(self) -> None:
        if programme := self._chosen():
            self.experiment_wanted.emit(programme)


def _line_of(found: "Finding") -> tuple[str, ...]:
    """An effect that was found, as a line of the table."""
    return (
        effect_name(found.name),
        _alternatives(found.others),
        in_language(found.belongs_to),
        local(found.coefficients),
        local(found.p_value),
    )


def _reservations(loop: LoopSummary) -> Iterator[str]:
    """What is not identifiable and why, and on what the values depend."""
    for name, why in loop.not_identifiable:
        yield tr("{name} is not identifiable: {reason}", name=name, reason=in_language(why))
    if loop.dependence:
        yield in_language(loop.dependence)


def _alternatives(effects: Sequence[str]) -> str:
    """What explains the data as well, in words."""
    return in_language(series(tuple(map(effect_name, effects)), "or")) if effects else ""


def _wrapped() -> QLabel:
    label = PlainLabel()
    label.setWordWrap(True)
    return label
