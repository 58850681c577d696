"""The screen Run: a unit from its serial number to its record."""

from collections.abc import Callable
from enum import Enum, auto
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from app.exits import Exit, JobError
from app.stand import LoadedStand
from app.wiring import Attendant
from procedures.errors import InputError
from procedures.events import Event, ReadingRequested, RunFinished, State, StateChanged
from procedures.progress import TimeLeft
from procedures.steps import Point
from window.look.numbers import local, minutes
from window.look.sentences import in_language, state_name
from window.screens.run_view import RunView
from window.widgets.motion_button import MotionButton
from window.widgets.prompts import ReadingPrompt
from window.widgets.run_form import RunForm
from window.work.activity import Activity, Calibration, Concluded
from window.work.background import Background
from window.work.bridge import EventBridge
from window.work.operator import SEATED, WindowOperator
from window.work.stand_worker import StandWorker


class Phase(Enum):
    """What the screen is busy with."""

    IDLE = auto()
    RUNNING = auto()
    CONCLUDING = auto()
    """The head stands; what was measured is analysed and stored."""


class RunScreen(QWidget):
    """Form, prompts, progress, and the view of the run; knows which of its buttons mean something now."""

    concluded = Signal(object)
    """`Concluded`."""
    refused = Signal(object)
    """An exception that the person must see."""
    state_changed = Signal(str)

    def __init__(
        self,
        worker: StandWorker,
        bridge: EventBridge,
        operator: WindowOperator,
        background: Background,
        store: Callable[[], Path],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._worker, self._operator, self._store = worker, operator, store
        self._attendant: Callable[[], Attendant] = lambda: Attendant(operator=lambda: operator, speed=1.0)
        self.phase, self.state = Phase.IDLE, State.IDLE
        self._setting_deg = 0.0
        self.form, self.view, self.reading = RunForm(), RunView(background), ReadingPrompt()
        self.start_button = MotionButton(self.tr("Start"), "F5")
        self.pause_button = MotionButton(self.tr("Pause"), "F6")
        self.resume_button = MotionButton(self.tr("Go on"), "F7")
        self._bar, self._left, self._state_label = QProgressBar(), QLabel(), QLabel()
        self._lay_out()
        self._connect(bridge)
        self._refresh()

    def use_stand(self, stand: LoadedStand, attendant: Callable[[], Attendant]) -> None:
        """Measure on a stand from now on."""
        self._attendant = attendant
        self.form.use_stand(stand)
        self._refresh()

    def start(self) -> None:
        """Begin what the form asks for."""
        try:
            job = self.form.job()
            job.plan()
        except InputError as error:
            self.refused.emit(error)
            return
        self.begin(Calibration(job=job, store=self._store()))

    def begin(self, activity: Activity, points: tuple[Point, ...] = ()) -> None:
        """Begin a run, whichever it is."""
        if self.phase is not Phase.IDLE:
            return
        plan = activity.job.plan()
        self.form.serial.setText(activity.job.serial_number)
        self.view.begin(plan, points)
        self._bar.setRange(0, plan.dwells)
        self._count(len(points), None)
        self.phase = Phase.RUNNING
        self._worker.begin(activity, self._attendant())
        self._refresh()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Be ready for the scanner."""
        super().showEvent(event)
        if self.phase is Phase.IDLE:
            self.form.await_scan()

    def _connect(self, bridge: EventBridge) -> None:
        self.start_button.clicked.connect(self.start)
        self.pause_button.clicked.connect(self._worker.pause)
        self.resume_button.clicked.connect(self._worker.resume)
        self.form.changed.connect(self._refresh)
        self.view.mount_prompt.seated.connect(self._seated)
        self.reading.answered.connect(self._operator.answer)
        bridge.announced.connect(self._hear)
        bridge.head_seen.connect(self.view.see)
        bridge.progressed.connect(self._count)
        self._operator.mount_asked.connect(self.view.ask_mount)
        self._operator.reading_asked.connect(self._ask_reading)
        self._worker.head_seen.connect(self.view.see)
        self._worker.stage.connect(self._conclude)
        self._worker.concluded.connect(self._end_well)
        self._worker.failed.connect(self._end_badly)

    def _lay_out(self) -> None:
        self.start_button.setObjectName("primary")
        self._state_label.setObjectName("heading")
        self.reading.hide()
        buttons = QHBoxLayout()
        for button in (self.start_button, self.pause_button, self.resume_button):
            buttons.addWidget(button)
        buttons.addWidget(self.form.summary, stretch=1)
        progress = QHBoxLayout()
        for part, stretch in ((self._state_label, 0), (self._bar, 1), (self._left, 0)):
            progress.addWidget(part, stretch)
        layout = QVBoxLayout(self)
        for row in (self.form, buttons, progress, self.reading):
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
            case RunFinished():
                self._ask_nothing()

    def _change(self, state: State) -> None:
        self.state = state
        if state not in (State.AWAITING_OPERATOR, State.RUNNING):
            self._ask_nothing()
        self._refresh()

    def _ask_reading(self, prompt: str) -> None:
        self.reading.show()
        self.reading.ask(self._setting_deg, prompt)

    def _seated(self) -> None:
        if self.view.asks_mount:
            self.view.ask_nothing()
            self._operator.answer(SEATED)

    def _ask_nothing(self) -> None:
        self.view.ask_nothing()
        self.reading.hide()

    def _count(self, done: int, left: TimeLeft | None) -> None:
        self._bar.setValue(done)
        self._bar.setFormat(f"{done} / {self._bar.maximum()}")
        text = "" if left is None else self.tr("{time} ± {error} left")
        self._left.setText(text.format(time=minutes(left.time_s), error=minutes(left.standard_error_s)) if left else "")

    def _conclude(self, stage: str) -> None:
        self.phase = Phase.CONCLUDING
        self._left.setText(
            {
                "fitting": self.tr("Fitting…"),
                "tracing": self.tr("Tracing what is left…"),
                "storing": self.tr("Storing…"),
                "reporting": self.tr("Writing the report…"),
            }.get(stage, stage)
        )
        self._refresh()

    def _end_well(self, concluded: Concluded) -> None:
        self._end(self.tr("Done"))
        self.concluded.emit(concluded)

    def _end_badly(self, error: Exception) -> None:
        began = self.phase is not Phase.IDLE
        self._end("")
        if began and isinstance(error, JobError) and error.status is Exit.STOPPED:
            self.view.log.say(in_language(str(error)))
        else:
            self.refused.emit(error)

    def _end(self, text: str) -> None:
        self.phase = Phase.IDLE
        self.state = State.IDLE
        self._ask_nothing()
        self._left.setText(text)
        self._refresh()
        self.form.await_scan()

    def _refresh(self) -> None:
        idle, running = self.phase is Phase.IDLE, self.phase is Phase.RUNNING
        paused = running and self.state is State.PAUSED
        self.form.setEnabled(idle)
        self.start_button.setEnabled(idle and bool(self.form.serial.text().strip()))
        self.pause_button.setEnabled(running and not paused)
        self.resume_button.setEnabled(paused)
        text = self.tr("Analysing") if self.phase is Phase.CONCLUDING else state_name(self.state)
        self._state_label.setText(text)
        self.state_changed.emit(local(text))
