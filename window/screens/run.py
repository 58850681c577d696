"""The screen Run: units from their serial numbers to their records."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from tumble.app.running import Job
from tumble.app.wiring import Attendant
from tumble.procedures.errors import InputError
from tumble.procedures.events import Event, ReadingRequested
from tumble.procedures.steps import Point
from tumble.window.look.language import tr
from tumble.window.look.numbers import local
from tumble.window.look.sentences import stopped_text
from tumble.window.screens.queue_panel import QueuePanel
from tumble.window.screens.queue_runner import QueueRunner
from tumble.window.screens.run_controls import RunControls
from tumble.window.screens.run_course import RunCourse, asks_nothing, was_stopped
from tumble.window.screens.run_state import Phase
from tumble.window.screens.run_view import RunView
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
    """Form, controls, queue, and the view of the run; puts them together."""

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
        self._operator, self._store = operator, store
        self._setting_deg, self.broken_off = 0.0, False
        """The latter: whether the last run came to no end, and somebody is to say what becomes of it."""
        self._adding = False
        """Whether the form is open beside a run, to fill the queue."""
        self.form = RunForm(lambda: worker.session.loaded, background)
        self.view = RunView(background, self.form.chosen_or_shipped())
        self.offered, self.line = ResumeOffer(), RunLine()
        self.controls = RunControls(self.form.summary)
        self.course = RunCourse(worker, bridge, attendant, self)
        self.queue = QueueRunner(self._begin, lambda: worker.session.loaded, store, self)
        self.queue_view = QueuePanel(self.queue)
        self._lay_out()
        self._connect_parts()
        self._connect_queue()
        self._connect_course()
        self._connect_stand(worker, bridge)
        self._refresh()

    @property
    def phase(self) -> Phase:
        """What the screen is busy with."""
        return self.course.now.phase

    def show_stand(self) -> None:
        """Show what there is to do on the stand that is chosen now."""
        self.form.plan_anew()
        self._forget_positions()
        self.course.see_rest()
        self._tell_unit()

    def offer(self, runs: "Sequence[CutOff]") -> None:
        """Offer to go on with the run that ended here before its time, or with one that another session left."""
        wanted = [run for run in runs if self.broken_off or not run.ending]
        self.offered.offer(wanted if self.phase is Phase.IDLE else [])

    def start(self) -> None:
        """Begin what the form asks for."""
        if job := self._asked():
            self.begin(Calibration(job=job, store=self._store()))

    def begin(self, activity: Activity, points: tuple[Point, ...] = ()) -> bool:
        """Begin a run, whichever it is, unless the stand is at work; returns whether it was begun."""
        self._adding = False
        return self._begin(activity, points)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Be ready for the scanner."""
        super().showEvent(event)
        if not self.course.now.running:
            self.form.await_scan()

    def _begin(self, activity: Activity, points: tuple[Point, ...] = ()) -> bool:
        try:
            plan = activity.job.plan()
            if not self.course.begin(activity):
                return False
        except InputError as error:
            self.refused.emit(error)
            return False
        self.broken_off = False
        self.unit_changed.emit(activity.job.serial_number, activity.job.operator)
        self.line.show_run(activity.job, plan)
        self.view.begin(activity.job, plan, points)
        self.controls.begin(plan.dwells, len(points))
        self.queue.hear_begun(activity)
        self.offered.withdraw()
        return True

    def _asked(self) -> Job | None:
        """What the form asks for; None where that is refused, which is told."""
        try:
            return self.form.job()
        except InputError as error:
            self.refused.emit(error)
            return None

    def _connect_parts(self) -> None:
        self.controls.start.clicked.connect(self.start)
        self.controls.pause.clicked.connect(self.course.pause)
        self.controls.resume.clicked.connect(self.course.go_on)
        self.controls.again.clicked.connect(self.course.repeat)
        self.offered.offered.connect(lambda offered: self.course.await_choice(offered and self.broken_off))
        self.form.changed.connect(self._refresh)
        self.form.changed.connect(self._tell_unit)
        self.form.dialog_wanted.connect(self.dialog_wanted)
        self.view.confirmed.connect(self._confirm)
        self.view.reading.answered.connect(self._answer_reading)

    def _connect_queue(self) -> None:
        self.controls.add.clicked.connect(self._add)
        self.controls.start_queue.clicked.connect(self._start_queue)
        self.controls.hold_queue.clicked.connect(self.queue.hold)
        self.view.unit_confirmed.connect(self.queue.confirm_unit)
        self.queue.changed.connect(self._show_queue)
        self.queue.unit_wanted.connect(self._ask_unit)
        self.queue.refused.connect(self.refused)

    def _connect_course(self) -> None:
        course = self.course
        self.queue.follow(course)
        course.changed.connect(self._refresh)
        course.heard.connect(self._hear)
        course.measured.connect(self._end)
        course.broke_off.connect(self._break_off)
        course.stage.connect(self._show_analysis)
        course.concluded.connect(self._conclude)
        course.failed.connect(self._fail)

    def _connect_stand(self, worker: StandWorker, bridge: EventBridge) -> None:
        bridge.position_seen.connect(self.view.see)
        bridge.progressed.connect(self.controls.count)
        self._operator.condition_asked.connect(self.view.ask)
        self._operator.reading_asked.connect(self._ask_reading)
        worker.position_seen.connect(self.view.see)
        worker.connected.connect(lambda identity: self.view.see_all(identity.statuses))
        worker.disconnected.connect(self._forget_positions)
        worker.stopping.connect(self.queue.hear_stop)
        worker.stage.connect(self._prepare)

    def _lay_out(self) -> None:
        self.offered.hide()
        self.view.tabs.addTab(self.queue_view, tr("Queue"))
        layout = QVBoxLayout(self)
        for row in (self.offered, self.line, self.form, self.controls):
            layout.addWidget(row)
        layout.addWidget(self.view, stretch=1)

    def _hear(self, event: Event) -> None:
        self.view.hear(event)
        if isinstance(event, ReadingRequested):
            self._setting_deg = event.setting_deg
        if asks_nothing(event):
            self.view.ask_nothing()

    def _tell_unit(self) -> None:
        """Say which unit is typed, unless another one is measured."""
        if not self.course.now.running:
            self.unit_changed.emit(self.form.serial.text().strip(), self.form.operator.text().strip())

    def _add(self) -> None:
        """Put what the form asks for into the queue; while a run goes on, open the form first."""
        if self.form.isHidden():
            self._adding = True
            self._refresh()
            self.form.await_scan()
        elif job := self._asked():
            self.queue.add(job, self.form.chosen, self.controls.repeats.value())
            self.controls.repeats.setValue(1)
            self.view.tabs.setCurrentWidget(self.queue_view)
            self.form.await_scan()

    def _start_queue(self) -> None:
        self.queue.start()
        self._refresh()

    def _show_queue(self) -> None:
        waiting, title, tabs = self.queue.queue.waiting, tr("Queue"), self.view.tabs
        tabs.setTabText(tabs.indexOf(self.queue_view), f"{title} ({waiting})" if waiting else title)
        self.controls.show_queue(waiting, self.queue.going)

    def _forget_positions(self) -> None:
        self.view.forget_positions(self.course.positioners)

    def _ask_reading(self, prompt: str) -> None:
        self.view.ask_reading(self._setting_deg, prompt)
        self.course.await_reading(True)

    def _answer_reading(self, text: str) -> None:
        self._operator.answer(text)
        self.view.ask_nothing()
        self.course.await_reading(False)

    def _confirm(self) -> None:
        if self.view.asks:
            self.view.ask_nothing()
            self._operator.answer(CONFIRMED)

    def _ask_unit(self, unit: str) -> None:
        if unit:
            self.view.ask_unit(unit)
        else:
            self.view.ask_nothing()
        self.course.await_unit(bool(unit))

    def _prepare(self, stage: str) -> None:
        if stage == PREPARING:
            self.view.log.say(tr("What was measured so far is analysed first; then the experiment begins."))

    def _show_analysis(self, stage: str) -> None:
        if not self.course.now.running:
            self.controls.say_stage(stage)

    def _end(self) -> None:
        self.view.ask_nothing()
        self.controls.say("")
        if not self._adding:
            self.form.show()
            self.form.await_scan()
        self._adding = self._adding and self.queue.going

    def _break_off(self, _: Activity, error: BaseException) -> None:
        self.broken_off = True
        self._end()
        self.broke_off.emit()
        if was_stopped(error) and not self.course.now.restless:
            self.view.log.say(stopped_text(len(self.view.points)))
        else:
            self.refused.emit(error)

    def _conclude(self, _: Activity, concluded: Concluded) -> None:
        if not self.course.now.running:
            self.controls.say(tr("Done"))
        self.concluded.emit(concluded)

    def _fail(self, _: Activity, error: BaseException) -> None:
        """An analysis came to no end: what was measured is offered, unless another run has the stand."""
        self.broken_off = not self.course.now.running
        self.broke_off.emit()
        self.refused.emit(error)

    def _refresh(self) -> None:
        now, free = self.course.now, self.course.is_free
        self.form.setVisible(not now.running or self._adding)
        self.controls.show_form(not now.running or self._adding)
        self.line.setVisible(now.running)
        self.controls.show_state(now, free, bool(self.form.serial.text().strip()))
        self.offered.allow(free)
        if now.running:
            self.queue.hear_waiting(now.waiting)
        self.state_changed.emit(local(now.text), now.restless)
        if free:
            self.queue.proceed()
