"""The screen Result: what a calibration says, and what to do next."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QHBoxLayout, QTabWidget, QVBoxLayout, QWidget

from tumble.app.running import Job
from tumble.app.stand import LoadedStand, same_instruments
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.first_method import FIRST
from tumble.procedures.programmes import load_programme
from tumble.window.look.language import tr
from tumble.window.look.moments import written_moment_text
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language, lot_text
from tumble.window.look.tints import AMBER, GREEN, GREY, RED, Tint
from tumble.window.parts import ResultTab
from tumble.window.registry import window_part
from tumble.window.screens.loop_view import LoopView
from tumble.window.screens.values_view import ValuesView
from tumble.window.widgets.action_menu import ActionButton
from tumble.window.widgets.banner import Banner
from tumble.window.widgets.correlation_table import CorrelationTable
from tumble.window.work.activity import Concluded, FurtherExperiment
from tumble.window.work.background import Background
from tumble.window.work.presentation import Presentation
from tumble.window.work.presented import presented

_OF_THE_PAGE: Final = "What that does to the parameters is said below the results."
"""True of the report; here a tab says it."""


class ResultScreen(QWidget):
    """Verdict and parameters, fit, residuals, correlations, and the closed loop."""

    experiment_wanted = Signal(object)
    """`FurtherExperiment`."""
    refused = Signal(object)
    """An exception that the person must see."""

    def __init__(self, background: Background, stand: Callable[[], LoadedStand], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._background, self._stand = background, stand
        self._store = Path()
        self.presentation: Presentation | None = None
        self.banner = Banner()
        self.verdict, self._subject, self._notices = PlainLabel(), PlainLabel(), PlainLabel()
        self._values = ValuesView()
        self.table = self._values.table
        self.report_button = ActionButton(self.table.table.offer(tr("Open the &report"), self._open_report))
        self.correlation, self.loop = CorrelationTable(), LoopView()
        self.tabs, self._part = QTabWidget(), window_part(FIRST)
        self._own: Sequence[ResultTab] = ()
        """Tabs of the method that is shown."""
        self._lay_out()
        self.loop.experiment_wanted.connect(self._run_experiment)
        self._show_nothing()

    def allow_runs(self, allowed: bool) -> None:
        """Whether the stand is free."""
        self.loop.allow_runs(allowed)

    def show_result(self, concluded: Concluded, store: Path) -> None:
        """Show a result as soon as it is worked out."""
        self._store, present = store, window_part(concluded.method).present
        self._background.start(partial(presented, present, concluded, store), self._show)

    def _show_nothing(self) -> None:
        for part in (self.banner, self._subject, self._notices):
            part.hide()
        self.verdict.setText(tr("There is no result yet: run a programme, or open a record."))
        self.report_button.action.setEnabled(False)
        self.tabs.setEnabled(False)

    def _show(self, presentation: Presentation) -> None:
        self.presentation = presentation
        self._show_head(presentation)
        self._values.show_presentation(presentation)
        self._take_tabs_of(presentation.concluded.method)
        for tab in self._own:
            tab.show(presentation)
        self._show_generic_tabs(presentation)
        self.tabs.setEnabled(True)

    def _take_tabs_of(self, method: str) -> None:
        """Put the tabs of another method between the parameters and the correlations."""
        if window_part(method) is self._part and self._own:
            return
        for tab in self._own:
            self.tabs.removeTab(self.tabs.indexOf(tab.widget))
            tab.widget.deleteLater()
        self._part = window_part(method)
        self._own = self._part.tabs()
        for place, tab in enumerate(self._own, 1):
            self.tabs.insertTab(place, tab.widget, tab.title)

    def _show_generic_tabs(self, presentation: Presentation) -> None:
        """Correlations and closed loop, each where the method states one."""
        correlations, loop = presentation.correlations, presentation.loop
        self.tabs.setTabVisible(self.tabs.indexOf(self.correlation), correlations is not None)
        self.tabs.setTabVisible(self.tabs.indexOf(self.loop), loop is not None)
        if correlations is not None:
            self.correlation.show_correlations(correlations)
        if loop is not None:
            self.loop.show_loop(loop)

    def _show_head(self, presentation: Presentation) -> None:
        concluded = presentation.concluded
        self.banner.say(*_banner(presentation.verdict.outcome))
        for part in (self.banner, self._subject):
            part.show()
        self.verdict.setObjectName(
            {Outcome.PASS: "good", Outcome.NO_LIMITS: "heading"}.get(presentation.verdict.outcome, "bad")
        )
        self.verdict.style().polish(self.verdict)
        self.verdict.setText(self._verdict_text(presentation.verdict))
        origin = concluded.traced.provenance
        unit, measured_at = (origin.serial_number, lot_text(origin.lot)), written_moment_text(origin.measured_at)
        parts = (*unit, origin.programme_name, measured_at, origin.operator, concluded.record_id)
        self._subject.setText(" · ".join(part for part in parts if part))
        notices = notices_of(presentation)
        self._notices.setText("\n".join(f"⚠ {notice}" for notice in notices))
        self._notices.setVisible(bool(notices))
        if notices and presentation.verdict.outcome is Outcome.NO_LIMITS:
            self.verdict.setText(tr("The programme states no limits; read the warnings before you use a value"))
        self.report_button.action.setEnabled(concluded.report is not None)

    def _verdict_text(self, verdict: Verdict) -> str:
        """What is decided, and of which model where that is not the declared one."""
        failed, undecided = (", ".join(verdict.named(each)) for each in (Outcome.FAIL, Outcome.NOT_DECIDED))
        parts = [
            tr("The programme states no limits") if verdict.outcome is Outcome.NO_LIMITS else "",
            tr("✓ Inside the limits") if verdict.outcome is Outcome.PASS else "",
            tr("✗ Outside the limits: {names}", names=failed) if failed else "",
            tr("? Not decided: {names}", names=undecided) if undecided else "",
            tr("(with what was found)") if verdict.judged is Model.AUGMENTED else "",
        ]
        return " ".join(filter(None, parts))

    def _lay_out(self) -> None:
        for label in (self.verdict, self._subject, self._notices):
            label.setWordWrap(True)
        head = QHBoxLayout()
        head.addWidget(self.verdict, stretch=1)
        head.addWidget(self.report_button)
        for title, part in (
            (tr("Parameters"), self._values),
            (tr("Correlations"), self.correlation),
            (tr("Effects"), self.loop),
        ):
            self.tabs.addTab(part, title)
        self._take_tabs_of(FIRST)
        layout = QVBoxLayout(self)
        layout.addWidget(self.banner)
        layout.addLayout(head)
        layout.addWidget(self._subject)
        layout.addWidget(self._notices)
        layout.addWidget(self.tabs, stretch=1)

    def _open_report(self) -> None:
        if self.presentation and self.presentation.concluded.report:
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(self.presentation.concluded.report)))

    def _run_experiment(self, programme: str) -> None:
        if self.presentation is None:
            return
        concluded, stand = self.presentation.concluded, self._stand()
        origin = concluded.traced.provenance
        if not same_instruments(origin.stand, stand):
            text = tr(
                "{unit} was measured at the stand {its}, and the stand {chosen} is on screen: choose {its} on the "
                "screen Stand, then run the experiment",
                unit=origin.serial_number,
                its=origin.stand_name,
                chosen=stand.file.name,
            )
            self.refused.emit(InputError(text))
            return
        job = Job(
            stand=stand,
            programme=load_programme(programme),
            serial_number=origin.serial_number,
            lot=origin.lot,
            operator=origin.operator,
        )
        try:
            job.plan()
        except InputError as error:
            self.refused.emit(error)
            return
        self.experiment_wanted.emit(FurtherExperiment(job=job, store=self._store, before=concluded.recordings))


def notices_of(presentation: Presentation) -> list[str]:
    """What must be read before the numbers, each once; files by their names, and without what a page says of itself."""
    undecided = [each for each in presentation.verdict.parameters if each.outcome is Outcome.NOT_DECIDED]
    told = [*(_told(each) for each in undecided), *presentation.notices]
    texts = [in_language(_without(_OF_THE_PAGE, notice)) for notice in told]
    for path in presentation.concluded.recordings:
        texts = [text.replace(str(path), path.name) for text in texts]
    return list(dict.fromkeys(texts))


def _told(judgement: Judgement) -> str:
    """Why nothing is decided, and what to do, but for a command of the terminal: a tab has the experiment."""
    is_command = isinstance(judgement.remedy, Message) and "command" in judgement.remedy.fields
    return (replace(judgement, remedy="") if is_command else judgement).sentence


def _without(sentence: str, notice: str) -> str:
    """A notice of several sentences without one of them."""
    if not isinstance(notice, Message) or sentence not in notice.fields.values():
        return notice
    return Message.joined(" ", [str(part) for part in notice.fields.values() if part != sentence])


def _banner(outcome: Outcome) -> tuple[str, Tint]:
    """The verdict in a word or two, and its colour."""
    return {
        Outcome.PASS: (tr("✓ PASS"), GREEN),
        Outcome.FAIL: (tr("✗ FAIL"), RED),
        Outcome.NOT_DECIDED: (tr("? NOT DECIDED"), AMBER),
        Outcome.NO_LIMITS: (tr("NO LIMITS"), GREY),
    }[outcome]
