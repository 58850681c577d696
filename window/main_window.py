"""The window: screens and threads put together, and the way out."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeyEvent, QShowEvent
from PySide6.QtWidgets import QMainWindow, QWidget

from tumble.app.stand import LoadedStand
from tumble.window.badges import Badges
from tumble.window.beginning import Beginning
from tumble.window.call import Caller
from tumble.window.choices import Choices
from tumble.window.faults import fault_notice
from tumble.window.finding import Finding
from tumble.window.frame import Frame
from tumble.window.look.icons import window_icon
from tumble.window.look.keys import KeyedAction
from tumble.window.look.language import tr
from tumble.window.menus import Menus
from tumble.window.place import keep_on_screen, remember_place, restore_place
from tumble.window.plots.saving import SavingPlots
from tumble.window.recent import remember_stand
from tumble.window.remedies import Remedies
from tumble.window.screens.help import HelpScreen
from tumble.window.screens.records import RecordsScreen
from tumble.window.screens.result import ResultScreen
from tumble.window.screens.run import RunScreen
from tumble.window.screens.run_state import Phase
from tumble.window.screens.settings import SettingsScreen
from tumble.window.screens.stand import StandScreen, remembered_stand
from tumble.window.shortcuts import Shortcut, shortcuts, take_keys
from tumble.window.stop_guard import STOP_KEYS, StopGuard
from tumble.window.way_out import WayOut
from tumble.window.widgets.notice import ACT_KEY, Notice
from tumble.window.widgets.rail import Place
from tumble.window.work.activity import Concluded
from tumble.window.work.background import Background
from tumble.window.work.bridge import EventBridge
from tumble.window.work.operator import WindowOperator
from tumble.window.work.session import StandIdentity
from tumble.window.work.stand_worker import StandWorker


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
        self.way_out, self.choices = WayOut(self.worker, lambda: self.busy, self), Choices(lambda: self.busy, self)
        self._make_screens()
        self.frame = Frame(_places(), self._in_order, lambda: self.menuBar().minimumSizeHint().height())
        self.strip, self.stop_bar, self.dialogs = self.frame.strip, self.frame.stop_bar, self.frame.dialogs
        self.notices, self.finder = self.frame.notices, self.frame.finder
        self.setCentralWidget(self.frame)
        self._plots = SavingPlots(self, self.frame, self.tell)
        self.setWindowIcon(window_icon())
        self.menus, self._guard = Menus(self.menuBar(), self), StopGuard(self.stop_bar.button, self)
        self._badges, self._caller = Badges(self.frame.rail), Caller(self)
        self._remedies = Remedies(
            is_free=lambda: not (self.busy or self.worker.session.is_connected),
            stand=self.stand,
            resume=self.records.resume,
        )
        self.finding = Finding(
            frame=self.frame,
            menus=self.menuBar(),
            background=self.background,
            store=lambda: self.store,
            open_stand=self._open_stand,
            show_unit=self._show_unit,
        )
        self.beginning = Beginning(self.run, self.stand, lambda: self.worker.session, lambda: self.busy, self)
        self._connect()
        self.frame.rail.choose(restore_place(self, len(self._in_order)))
        self._show_stand(loaded)
        self.stand.suit(self.run.form.chosen_or_shipped().method)
        self.run.queue.open()
        if trouble is not None:
            self.tell(trouble)

    @property
    def _in_order(self) -> tuple[QWidget, ...]:
        return (self.stand, self.run, self.result, self.records, self.settings, self.help)

    @property
    def busy(self) -> bool:
        """Whether the stand is at work."""
        return self.worker.busy or self.run.phase is not Phase.IDLE

    def open(self, screen: QWidget) -> None:
        """Show one of the screens."""
        self.frame.open(screen)

    def tell(self, error: BaseException) -> None:
        """Show what went wrong, and what helps; does not wait."""
        self.notices.show_notice(fault_notice(error, self._remedies.remedy_of(error)))

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
        remember_place(self, self.frame.rail.current)
        self.worker.leave()
        self.run.course.leave()
        self.run.queue.leave()
        self.records.surveyor.leave()
        self.background.leave()
        event.accept()
        self.left.emit()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Be wholly on the screen, STOP above all."""
        super().showEvent(event)
        keep_on_screen(self)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802  # Qt's name
        """Esc closes the dialog or the newest notice; where there is none it says what stops instead."""
        if event.key() != Qt.Key.Key_Escape:
            super().keyPressEvent(event)
        elif not self.frame.close_newest() and self.busy:
            self._say_what_stops()

    def find_keys(self) -> list[Shortcut]:
        """Keys that may be changed."""
        return shortcuts(self)

    def _open_stand(self, path: str) -> None:
        self.open(self.stand)
        self.stand.open(Path(path))

    def _show_unit(self, serial_number: str) -> None:
        self.open(self.records)
        self.records.search.serial.setText(serial_number)

    def _say_what_stops(self) -> None:
        text = tr("Esc stops nothing: it closes dialogs and notices. STOP is {key}.", key=STOP_KEYS[0])
        self.notices.show_notice(Notice(text=text))

    def _make_screens(self) -> None:
        self.stand = StandScreen(self.worker, self.bridge, self.operator)
        self.run = RunScreen(
            self.worker, self.bridge, self.stand.attendant, self.operator, self.background, lambda: self.store
        )
        self.result = ResultScreen(self.background, lambda: self.worker.session.loaded)
        self.records = RecordsScreen(self.background, lambda: self.store)
        self.settings, self.help = SettingsScreen(self.find_keys), HelpScreen(self.find_keys, lambda: self.store)

    def _connect(self) -> None:
        self._connect_stand()
        self._connect_screens()
        self._connect_choices()
        self._connect_troubles()

    def _connect_stand(self) -> None:
        worker, bar = self.worker, self.stop_bar
        for stop in (bar.stop_wanted, self._guard.wanted):
            stop.connect(worker.stop)
        worker.working.connect(self._show_working)
        worker.position_seen.connect(bar.show_position)
        worker.connected.connect(self._show_connected)
        worker.disconnected.connect(bar.forget_positions)
        worker.disconnected.connect(lambda: self._badges.show_connected(False))
        worker.chosen.connect(self._show_stand)
        self.bridge.position_seen.connect(bar.show_position)
        self.background.busy.connect(bar.show_busy)

    def _connect_screens(self) -> None:
        run, records = self.run, self.records
        run.state_changed.connect(self._show_state)
        run.unit_changed.connect(self.strip.show_unit)
        run.form.method_chosen.connect(self.stand.suit)
        run.concluded.connect(self._conclude)
        run.queue_view.record_wanted.connect(records.open_record)
        run.offered.discard_wanted.connect(records.discard)
        run.offered.wanted.connect(records.resume)
        run.offered.analysis_wanted.connect(records.analyse_cut_off)
        run.broke_off.connect(records.refresh)
        records.found_cut_off.connect(run.offer)
        records.found_cut_off.connect(lambda found: self._badges.show_cut_off(len(found)))
        records.opened.connect(self._show_result)
        records.opened.connect(run.queue.hear_result)
        records.resume_wanted.connect(self.beginning.begin)
        self.result.experiment_wanted.connect(self.beginning.begin)
        self.beginning.begun.connect(lambda: self.open(self.run))
        self.beginning.resumed.connect(self.notices.withdraw)
        self.frame.rail.chosen.connect(self._see)

    def _connect_choices(self) -> None:
        menus, settings, choices = self.menus, self.settings, self.choices
        for shade_wanted in (menus.shade_wanted, settings.shade_wanted):
            shade_wanted.connect(choices.choose_shade)
        for language_wanted in (menus.language_wanted, settings.language_wanted):
            language_wanted.connect(choices.choose_language)
        menus.larger_wanted.connect(choices.enlarge)
        settings.scale_wanted.connect(choices.choose_scale)
        settings.keys_changed.connect(lambda: take_keys(self))
        for shows in (menus.show_choices, settings.show_choices, self.dress_wanted.emit):
            choices.dress_wanted.connect(shows)
        choices.restart_wanted.connect(self.restart_wanted)
        choices.notice_wanted.connect(self.notices.show_notice)
        menus.find_wanted.connect(self.finding.begin)
        menus.handbook_wanted.connect(lambda: self._help(self.help.open_handbook))
        menus.about_wanted.connect(lambda: self._help(self.help.open_about))
        menus.quit_wanted.connect(self.close)
        act = KeyedAction(tr("Do what the newest notice offers"), ACT_KEY, self)
        act.triggered.connect(self.notices.act_newest)
        self.addAction(act)

    def _connect_troubles(self) -> None:
        self.way_out.clear.connect(self.close)
        for asking in (self.stand, self.run, self.records, self.beginning, self.way_out):
            asking.dialog_wanted.connect(self.dialogs.show_dialog)
        screens = (self.stand.refused, self.run.refused, self.result.refused, self.records.refused)
        refused = (*screens, self.way_out.refused)
        for trouble in (*refused, self.worker.failed, self.background.failed, self.bridge.failed):
            trouble.connect(self.tell)

    def _help(self, show: Callable[[], None]) -> None:
        self.open(self.help)
        show()

    def _see(self, _number: int) -> None:
        """A screen was opened; a result that is on it is new no more."""
        if self.frame.current is self.result:
            self._badges.show_result(seen=True)

    def _show_state(self, text: str, fault: bool) -> None:
        mood = self.run.course.now.mood
        self.stop_bar.show_state(text, fault)
        self.strip.show_state(text, mood)
        self._badges.show_mood(mood, text)
        self._caller.hear(mood)

    def _show_connected(self, identity: StandIdentity) -> None:
        self._badges.show_connected(True)
        for name, status in identity.statuses.items():
            self.stop_bar.show_position(name, status)

    def _show_working(self, _working: bool) -> None:
        free = not self.worker.busy
        self.result.allow_runs(free)
        self.records.allow_runs(free)

    def _show_stand(self, loaded: LoadedStand) -> None:
        self.setWindowTitle(f"{loaded.file.name} – {self.store.resolve().name} – tumble")
        if loaded.path is not None:
            remember_stand(loaded.path)
        self.strip.show_stand(loaded.file.name)
        self.stop_bar.forget_positions()
        self._badges.show_connected(False)
        self.run.show_stand()

    def _show_result(self, concluded: Concluded) -> None:
        self.result.show_result(concluded, self.store)
        self.records.refresh()
        self.open(self.result)

    def _conclude(self, concluded: Concluded) -> None:
        """Show a result to whoever watched the run; a badge to whoever is elsewhere, or is to decide on another."""
        if self.frame.current is self.run and self.run.course.now.is_over and not self.run.broken_off:
            self._show_result(concluded)
            return
        self.result.show_result(concluded, self.store)
        self.records.refresh()
        self._badges.show_result(seen=self.frame.current is self.result)


def _places() -> tuple[Place, ...]:
    """The screens as the rail shows them, in its order."""
    return (
        Place(sign="stand", title=tr("Stand"), usual_key="Ctrl+1"),
        Place(sign="run", title=tr("Run"), usual_key="Ctrl+2"),
        Place(sign="result", title=tr("Result"), usual_key="Ctrl+3"),
        Place(sign="records", title=tr("Records"), usual_key="Ctrl+4"),
        Place(sign="settings", title=tr("Settings"), usual_key="Ctrl+,", is_apart=True),
        Place(sign="help", title=tr("Help"), usual_key="F1", is_apart=True),
    )
