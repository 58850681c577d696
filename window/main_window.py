"""The frame around the screens: navigation, dialogs, STOP, menus, and the way out."""

from pathlib import Path
from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeyEvent, QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QMainWindow, QStackedWidget, QVBoxLayout, QWidget

from tumble.app.stand import LoadedStand
from tumble.window.look.language import tr
from tumble.window.menus import Menus
from tumble.window.place import keep_on_screen, remember_place, restore_place
from tumble.window.screens.records import RecordsScreen
from tumble.window.screens.result import ResultScreen
from tumble.window.screens.run import RunScreen
from tumble.window.screens.run_state import Phase
from tumble.window.screens.stand import StandScreen, remembered_stand
from tumble.window.stop_guard import STOP_KEYS, StopGuard
from tumble.window.way_out import WayOut
from tumble.window.widgets.dialog import Dialog, Dialogs, QuestionDialog
from tumble.window.widgets.navigation import Navigation
from tumble.window.widgets.problem import ProblemDialog
from tumble.window.widgets.screen_area import ScreenArea
from tumble.window.widgets.stop_bar import StopBar
from tumble.window.widgets.top_strip import TopStrip
from tumble.window.work.activity import Activity, Concluded
from tumble.window.work.background import Background
from tumble.window.work.bridge import EventBridge
from tumble.window.work.operator import WindowOperator
from tumble.window.work.session import StandIdentity
from tumble.window.work.stand_worker import StandWorker

_GAPS: Final = 24
"""Pixels between the parts of the window, together."""


class MainWindow(QMainWindow):
    """Puts screens and threads together."""

    restart_wanted = Signal()
    """The window is to be made anew, in another language."""
    dress_wanted = Signal()
    """Colours or text size were chosen anew."""
    left = Signal()
    """The window is closed, and everything behind it is at its end."""

    def __init__(self, store: Path) -> None:
        super().__init__()
        self.store = store
        self.bridge, self.operator, self.background = EventBridge(self), WindowOperator(self), Background(self)
        loaded, trouble = remembered_stand()
        self.worker = StandWorker(self.bridge, loaded, self)
        self.stand = StandScreen(self.worker, self.bridge, self.operator)
        self.run = RunScreen(
            self.worker, self.bridge, self.stand.attendant, self.operator, self.background, lambda: self.store
        )
        self.result = ResultScreen(self.background, lambda: self.worker.session.loaded)
        self.records = RecordsScreen(self.background, lambda: self.store)
        self.strip, self.stop_bar, self.dialogs = TopStrip(), StopBar(), Dialogs(self._room)
        self.way_out = WayOut(self.worker, lambda: self.busy, self)
        self._guard = StopGuard(self.stop_bar.button, self)
        self._screens = QStackedWidget()
        titles = (tr("Stand"), tr("Run"), tr("Result"), tr("Records"))
        self._navigation = Navigation(titles)
        self.menus = Menus(self.menuBar(), lambda: self.busy, self)
        self._lay_out()
        self._connect()
        self._navigation.choose(restore_place(self))
        self._show_stand(loaded)
        self.run.queue.open()
        if trouble is not None:
            self.tell(trouble)

    @property
    def _in_order(self) -> tuple[QWidget, ...]:
        return (self.stand, self.run, self.result, self.records)

    @property
    def busy(self) -> bool:
        """Whether the stand is at work."""
        return self.worker.busy or self.run.phase is not Phase.IDLE

    def open(self, screen: QWidget) -> None:
        """Show one of the screens."""
        self._navigation.choose(self._in_order.index(screen))

    def tell(self, error: BaseException) -> None:
        """Show what went wrong; does not wait."""
        self.dialogs.show_dialog(ProblemDialog(error))

    def fail(self, error: BaseException) -> None:
        """Bring the head to rest after a fault of the program, and show it."""
        self.worker.stop()
        self.tell(error)

    def leave(self) -> None:
        """Close without asking, as a signal of the system demands."""
        self.way_out.leave()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802  # Qt's name
        """Leave only once the head stands, and ask before while anything goes on."""
        if not self.way_out.is_open():
            event.ignore()
            return
        remember_place(self, self._navigation.current)
        self.worker.leave()
        self.run.course.leave()
        self.records.surveyor.leave()
        self.background.leave()
        event.accept()
        self.left.emit()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Be wholly on the screen, STOP above all."""
        super().showEvent(event)
        keep_on_screen(self)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Esc closes the newest dialog; where there is none it says what stops instead."""
        if event.key() != Qt.Key.Key_Escape:
            super().keyPressEvent(event)
        elif not self.dialogs.close_newest() and self.busy:
            self._say_what_stops()

    def _say_what_stops(self) -> None:
        text = tr("Esc stops nothing: it closes dialogs. STOP is {key}.", key=STOP_KEYS[0])
        self.dialogs.show_dialog(Dialog(tr("Not stopped"), text, "fault"))

    def _room(self) -> int:
        """What navigation, menus and STOP leave of the height."""
        kept = (self.menuBar(), self._navigation, self.stop_bar)
        needed = sum(part.minimumSizeHint().height() for part in kept) + self.strip.height()
        return max(self.height() - needed - _GAPS, 0)

    def _lay_out(self) -> None:
        for screen in self._in_order:
            self._screens.addWidget(ScreenArea(screen))
        middle = QWidget()
        across = QHBoxLayout()
        across.addWidget(self._navigation)
        across.addWidget(self._screens, stretch=1)
        down = QVBoxLayout(middle)
        down.setContentsMargins(0, 0, 0, 0)
        down.addWidget(self.strip)
        down.addLayout(across, stretch=1)
        down.addWidget(self.dialogs)
        down.addWidget(self.stop_bar)
        self.setCentralWidget(middle)

    def _connect(self) -> None:
        worker, bar = self.worker, self.stop_bar
        self._navigation.chosen.connect(self._screens.setCurrentIndex)
        for stop in (bar.stop_wanted, self._guard.wanted):
            stop.connect(worker.stop)
        worker.working.connect(self._show_working)
        worker.position_seen.connect(bar.show_position)
        worker.connected.connect(self._show_connected)
        worker.disconnected.connect(bar.forget_positions)
        worker.chosen.connect(self._show_stand)
        self.bridge.position_seen.connect(bar.show_position)
        self.background.busy.connect(bar.show_busy)
        self.run.state_changed.connect(bar.show_state)
        self.run.state_changed.connect(lambda text, _fault: self.strip.show_state(text, self.run.course.now.mood))
        self.run.unit_changed.connect(self.strip.show_unit)
        self.run.concluded.connect(self._show_run_result)
        self.run.queue_view.record_wanted.connect(self.records.open_record)
        self.run.offered.discard_wanted.connect(self.records.discard)
        self.run.offered.wanted.connect(self.records.resume)
        self.run.offered.analysis_wanted.connect(self.records.analyse_cut_off)
        self.run.broke_off.connect(self.records.refresh)
        self.records.found_cut_off.connect(self.run.offer)
        self.result.experiment_wanted.connect(self._begin)
        self.records.opened.connect(self._show_result)
        self.records.opened.connect(self.run.queue.hear_result)
        self.records.resume_wanted.connect(self._begin)
        self.menus.dress_wanted.connect(self.dress_wanted)
        self.menus.restart_wanted.connect(self.restart_wanted)
        self.menus.quit_wanted.connect(self.close)
        self.way_out.clear.connect(self.close)
        for asking in (self.stand, self.run, self.records, self.menus, self.way_out):
            asking.dialog_wanted.connect(self.dialogs.show_dialog)
        screens = (self.stand.refused, self.run.refused, self.result.refused, self.records.refused)
        refused = (*screens, self.way_out.refused)
        for trouble in (*refused, worker.failed, self.background.failed, self.bridge.failed):
            trouble.connect(self._show_failure)

    def _show_failure(self, error: BaseException) -> None:
        self.tell(error)

    def _show_connected(self, identity: StandIdentity) -> None:
        for name, status in identity.statuses.items():
            self.stop_bar.show_position(name, status)

    def _show_working(self, _working: bool) -> None:
        free = not self.worker.busy
        self.result.allow_runs(free)
        self.records.allow_runs(free)

    def _show_stand(self, loaded: LoadedStand) -> None:
        self.setWindowTitle(f"{loaded.file.name} – {self.store.resolve().name} – tumble")
        self.strip.show_stand(loaded.file.name)
        self.stop_bar.forget_positions()
        self.run.show_stand()

    def _begin(self, activity: Activity, points: tuple[object, ...] = ()) -> None:
        """Begin a run on the stand that is on screen; one of another stand asks for that first."""
        its, shown = activity.job.stand, self.worker.session
        if self.worker.busy or shown.is_of(its):
            self._begin_here(activity, points)
            return
        text = tr(
            "This run was measured at the stand {its} ({path}); on screen is the stand {shown}. "
            "Leave that one, and go on with the run at {its}?",
            its=its.file.name,
            path=its.path or tr("the simulated stand that is built in"),
            shown=shown.loaded.file.name,
        )
        question = QuestionDialog(
            tr("Another stand"),
            text,
            tr("Take the stand {its}, and go on", its=its.file.name),
        )
        question.agreed.connect(lambda: self._begin_there(activity, points))
        self.dialogs.show_dialog(question)

    def _begin_there(self, activity: Activity, points: tuple[object, ...]) -> None:
        if self.stand.use(activity.job.stand):
            self._begin_here(activity, points)

    def _begin_here(self, activity: Activity, points: tuple[object, ...]) -> None:
        if self.run.begin(activity, points):  # type: ignore[arg-type]  # signals carry objects
            self.open(self.run)

    def _show_run_result(self, concluded: Concluded) -> None:
        """Show what a run gave, unless the next one goes on, which is looked at."""
        if self.run.phase is Phase.RUNNING:
            self.records.refresh()
        else:
            self._show_result(concluded)

    def _show_result(self, concluded: Concluded) -> None:
        self.result.show_result(concluded, self.store)
        self.records.refresh()
        self.open(self.result)
