"""The screen Run: a unit from its serial number to its record."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from tumble.app.exits import Exit, JobError
from tumble.app.wiring import Attendant
from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.errors import InputError
from tumble.procedures.events import Event, ReadingRequested, RunFinished, State, StateChanged
from tumble.procedures.progress import TimeLeft
from tumble.procedures.steps import Point
from tumble.window.look.language import tr
from tumble.window.look.numbers import local, minutes
from tumble.window.look.sentences import stopped_text
from tumble.window.screens.run_state import Mood, Phase, RunState
from tumble.window.screens.run_view import RunView
from tumble.window.widgets.motion_button import MotionButton
from tumble.window.widgets.prompts import ReadingPrompt
from tumble.window.widgets.resume_offer import ResumeOffer
from tumble.window.widgets.run_form import RunForm
from tumble.window.widgets.run_line import RunLine
from tumble.window.work.activity import PREPARING, Activity, Calibration, Concluded
from tumble.window.work.background import Background
from tumble.window.work.bridge import EventBridge
from tumble.window.work.operator import CONFIRMED, WindowOperator
from tumble.window.work.stand_worker import StandWorker

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff


class RunScreen(QWidget):
    """Form, prompts, progress, and the view of the run; knows which of its buttons mean something now."""

    concluded = Signal(object)
    """`Concluded`."""
    refused = Signal(object)
    """An exception that the person must see."""
    dialog_wanted = Signal(object)
    """`Dialog`."""
    state_changed = Signal(str, bool)
    """Where the run stands, and whether that is a fault."""
    unit_changed = Signal(str, str)
    """Serial number and operator."""
    broke_off = Signal()
    """A run ended before its time."""
    resume_wanted = Signal(object)
    """Path of the recording."""
    analysis_wanted = Signal(object)
    """The same, of a run that is not to go on."""

    def __init__(
        self,
        worker: StandWorker,
        bridge: EventBridge,
        attendant: Callable[[], Attendant],
        operator: WindowOperator,
        background: Background,
        store: Callable[[], Path],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._worker, self._operator, self._store, self._attendant = worker, operator, store, attendant
        self._now, self._broken_off = RunState(), False
        self._setting_deg = 0.0
        self.form, self.reading = RunForm(lambda: worker.session.loaded), ReadingPrompt()
        self.view = RunView(background, self.form.chosen_or_shipped())
        self.offered, self.line = ResumeOffer(), RunLine()
        self.start_button = MotionButton(tr("Start"), "F5")
        self.pause_button = MotionButton(tr("Pause"), "F6")
        self.resume_button = MotionButton(tr("Go on"), "F7")
        self._bar, self._left, self._state_label = QProgressBar(), QLabel(), QLabel()
        self._lay_out()
        self._connect(bridge)
        self._refresh()

    @property
    def phase(self) -> Phase:
        """What the screen is busy with."""
        return self._now.phase

    @property
    def state(self) -> State:
        """Where the run stands."""
        return self._now.state

    @property
    def mood(self) -> Mood:
        """What that means to whoever sees it from afar."""
        return self._now.mood

    def show_stand(self) -> None:
        """Show what there is to do on the stand that is chosen now."""
        self.form.plan_anew()
        self._forget_positions()
        self._see_rest()
        self._tell_unit()

    def offer(self, runs: "Sequence[CutOff]") -> None:
        """Offer to go on with the run that ended here before its time, or with one that another session left."""
        wanted = [run for run in runs if self._broken_off or not run.ending]
        self.offered.offer(wanted if self.phase is Phase.IDLE else [])

    def start(self) -> None:
        """Begin what the form asks for."""
        try:
            job = self.form.job()
            job.plan()
        except InputError as error:
            self.refused.emit(error)
            return
        self.begin(Calibration(job=job, store=self._store()))

    def begin(self, activity: Activity, points: tuple[Point, ...] = ()) -> bool:
        """Begin a run, whichever it is, unless the stand is at work; returns whether it was begun."""
        try:
            plan = activity.job.plan()
            if self.phase is not Phase.IDLE or not self._worker.begin(activity, self._attendant()):
                return False
        except InputError as error:
            self.refused.emit(error)
            return False
        self.form.serial.setText(activity.job.serial_number)
        self.unit_changed.emit(activity.job.serial_number, activity.job.operator)
        self.line.show_run(activity.job, plan)
        self.view.begin(activity.job.programme, plan, points)
        self._bar.setRange(0, plan.dwells)
        self._count(len(points), None)
        self._now.phase, self._broken_off = Phase.RUNNING, False
        self.offered.hide()
        self._refresh()
        return True

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Be ready for the scanner."""
        super().showEvent(event)
        if self.phase is Phase.IDLE:
            self.form.await_scan()

    def _connect(self, bridge: EventBridge) -> None:
        self.start_button.clicked.connect(self.start)
        self.pause_button.clicked.connect(self._pause)
        self.resume_button.clicked.connect(self._go_on)
        self.offered.wanted.connect(self.resume_wanted)
        self.offered.analysis_wanted.connect(self.analysis_wanted)
        self.form.changed.connect(self._refresh)
        self.form.changed.connect(self._tell_unit)
        self.form.dialog_wanted.connect(self.dialog_wanted)
        self.view.confirmed.connect(self._confirm)
        self.reading.answered.connect(self._answer_reading)
        bridge.announced.connect(self._hear)
        bridge.position_seen.connect(self.view.see)
        bridge.progressed.connect(self._count)
        self._operator.condition_asked.connect(self.view.ask)
        self._operator.reading_asked.connect(self._ask_reading)
        worker = self._worker
        worker.position_seen.connect(self.view.see)
        worker.position_seen.connect(self._see_position)
        worker.connected.connect(self._see_rest)
        worker.disconnected.connect(self._forget_positions)
        worker.restless.connect(self._see_unrest)
        worker.working.connect(self._refresh)
        worker.stage.connect(self._show_stage)
        worker.concluded.connect(self._end_well)
        worker.broken_off.connect(self._end_badly)

    def _lay_out(self) -> None:
        self.start_button.setObjectName("primary")
        self._state_label.setObjectName("heading")
        self.reading.hide()
        self.offered.hide()
        buttons = QHBoxLayout()
        for button in (self.start_button, self.pause_button, self.resume_button):
            buttons.addWidget(button)
        buttons.addWidget(self.form.summary, stretch=1)
        progress = QHBoxLayout()
        for part, stretch in ((self._state_label, 0), (self._bar, 1), (self._left, 0)):
            progress.addWidget(part, stretch)
        layout = QVBoxLayout(self)
        for row in (self.offered, self.line, self.form, buttons, progress, self.reading):
            layout.addWidget(row) if isinstance(row, QWidget) else layout.addLayout(row)
        layout.addWidget(self.view, stretch=1)

    def _hear(self, event: Event) -> None:
        if self.phase is Phase.IDLE:
            return
        self.view.hear(event)
        match event:
            case StateChanged(state=state):
                self._change(state)
            case ReadingRequested(setting_deg=setting_deg):
                self._setting_deg = setting_deg
            case RunFinished(at_standstill=at_standstill):
                self._ask_nothing()
                self._now.settle(at_standstill)

    def _tell_unit(self) -> None:
        self.unit_changed.emit(self.form.serial.text().strip(), self.form.operator.text().strip())

    def _pause(self) -> None:
        self._now.pausing = True
        self._worker.pause()
        self._refresh()

    def _go_on(self) -> None:
        self._now.pausing = False
        self._worker.resume()
        self._refresh()

    def _forget_positions(self) -> None:
        self.view.dials.show_positioners(self._positioners)

    @property
    def _positioners(self) -> tuple[str, ...]:
        return tuple(self._worker.session.loaded.file.positioners)

    def _see_position(self, name: str, status: PositionerStatus) -> None:
        before = self._now.restless
        self._now.see(name, status.moving, self._positioners)
        if before != self._now.restless:
            self._refresh()

    def _see_rest(self, *_: object) -> None:
        self._now.settle(at_standstill=True)
        self._refresh()

    def _see_unrest(self) -> None:
        self._now.settle(at_standstill=False)
        self._refresh()

    def _change(self, state: State) -> None:
        self._now.change(state)
        if state not in (State.AWAITING_OPERATOR, State.RUNNING):
            self._ask_nothing()
        self._refresh()

    def _ask_reading(self, prompt: str) -> None:
        self.reading.show()
        self.reading.ask(self._setting_deg, prompt)
        self._now.reading = True
        self._refresh()

    def _answer_reading(self, text: str) -> None:
        self._now.reading = False
        self._operator.answer(text)
        self._refresh()

    def _confirm(self) -> None:
        if self.view.asks:
            self.view.ask_nothing()
            self._operator.answer(CONFIRMED)

    def _ask_nothing(self) -> None:
        self.view.ask_nothing()
        self.reading.hide()
        self._now.reading = False

    def _count(self, done: int, left: TimeLeft | None) -> None:
        self._bar.setUpdatesEnabled(False)  # it would be painted at once, and with it whatever else has changed
        self._bar.setValue(done)
        self._bar.setFormat(f"{done} / {self._bar.maximum()}")
        self._bar.setUpdatesEnabled(True)
        self._left.setText("" if left is None else _time_left(left))

    def _show_stage(self, stage: str) -> None:
        if stage == PREPARING:
            self.view.log.say(tr("What was measured so far is analysed first; then the experiment begins."))
        else:
            self._conclude(stage)

    def _conclude(self, stage: str) -> None:
        self._now.phase = Phase.CONCLUDING
        self._left.setText(
            {
                "fitting": tr("Fitting…"),
                "tracing": tr("Tracing what is left…"),
                "storing": tr("Storing…"),
                "reporting": tr("Writing the report…"),
            }.get(stage, stage)
        )
        self._refresh()

    def _end_well(self, concluded: Concluded) -> None:
        self._end(tr("Done"))
        self.concluded.emit(concluded)

    def _end_badly(self, error: BaseException) -> None:
        self._end("")
        self._broken_off = True
        self.broke_off.emit()
        if isinstance(error, JobError) and error.status is Exit.STOPPED and not self._now.restless:
            self.view.log.say(stopped_text(len(self.view.points)))
        else:
            self.refused.emit(error)

    def _end(self, text: str) -> None:
        self._now.end()
        self._ask_nothing()
        self._left.setText(text)
        self._refresh()
        self.form.await_scan()

    def _refresh(self) -> None:
        idle, running = self.phase is Phase.IDLE, self.phase is Phase.RUNNING
        paused, free = self._now.paused, idle and not self._worker.busy
        for part in (self.form, self.form.summary):
            part.setVisible(idle)
        self.line.setVisible(not idle)
        self.start_button.setEnabled(free and bool(self.form.serial.text().strip()))
        self.offered.button.setEnabled(free)
        self.pause_button.setEnabled(running and not paused and not self._now.pausing)
        self.resume_button.setEnabled(paused or self._now.pausing)
        text = self._now.text
        self._state_label.setText(text)
        self.state_changed.emit(local(text), self._now.restless)


def _time_left(left: TimeLeft) -> str:
    return tr("{time} ± {error} left", time=minutes(left.time_s), error=minutes(left.standard_error_s))
