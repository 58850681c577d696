"""The frame around the screens: navigation, STOP, menus, and the way out."""

from pathlib import Path
from typing import Final

from PySide6.QtCore import QByteArray, QSettings, Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QHBoxLayout,
    QMainWindow,
    QMessageBox,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from app.stand import LoadedStand
from drivers.protocols import HeadStatus
from window.menus import fill_menus
from window.screens.records import RecordsScreen
from window.screens.result import ResultScreen
from window.screens.run import Phase, RunScreen
from window.screens.stand import StandScreen
from window.widgets.navigation import Navigation
from window.widgets.problem import ProblemDialog
from window.widgets.screen_area import ScreenArea
from window.widgets.stop_bar import StopBar
from window.work.activity import Concluded
from window.work.background import Background
from window.work.bridge import EventBridge
from window.work.operator import WindowOperator
from window.work.stand_worker import StandWorker

_SIZE: Final = (1280, 800)


class MainWindow(QMainWindow):
    """Puts screens and threads together."""

    restart_wanted = Signal()
    """The window is to be made anew, in another language."""
    dress_wanted = Signal()
    """Colours or text size were chosen anew."""

    def __init__(self, store: Path) -> None:
        super().__init__()
        self.store = store
        self._working = self._leaving = False
        self.bridge, self.operator, self.background = EventBridge(self), WindowOperator(self), Background(self)
        self.worker = StandWorker(self.bridge, self)
        self.stand = StandScreen(self.worker, self.bridge, self.operator)
        self.run = RunScreen(self.worker, self.bridge, self.operator, self.background, lambda: self.store)
        self.result = ResultScreen(self.background)
        self.records = RecordsScreen(self.background, lambda: self.store)
        self.stop_bar = StopBar()
        self._screens = QStackedWidget()
        titles = (self.tr("Stand"), self.tr("Run"), self.tr("Result"), self.tr("Records"))
        self._navigation = Navigation(titles)
        self._lay_out()
        self._connect()
        fill_menus(self)
        self._restore()
        self._use_stand(self.stand.loaded)

    @property
    def _in_order(self) -> tuple[QWidget, ...]:
        return (self.stand, self.run, self.result, self.records)

    @property
    def busy(self) -> bool:
        """Whether the stand is at work."""
        return self._working or self.run.phase is not Phase.IDLE

    def open(self, screen: QWidget) -> None:
        """Show one of the screens."""
        self._navigation.choose(self._in_order.index(screen))

    def tell(self, error: BaseException) -> None:
        """Show what went wrong; does not wait."""
        dialog = ProblemDialog(error, self)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

    def fail(self, error: BaseException) -> None:
        """Bring the head to rest after a fault of the program, and show it."""
        self.worker.stop()
        self.tell(error)

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802  # Qt's name
        """Ask while a run goes on; leave only once the head stands."""
        running = self.run.phase is not Phase.IDLE
        if running and not self._leaving and not self._confirmed():
            event.ignore()
            return
        self._leaving = True
        if running:
            self.worker.stop()
            event.ignore()  # closed anew when the stand has come to rest
            return
        self._remember()
        self.worker.leave()
        self.background.leave()
        event.accept()

    def leave(self) -> None:
        """Close without asking, as a signal of the system demands."""
        self._leaving = True
        self.close()

    def _confirmed(self) -> bool:
        question = self.tr("A run is going on. Stop it at a standstill, and leave? Its complete points are kept.")
        buttons = QMessageBox.StandardButton
        asked = QMessageBox.question(self, self.tr("Leave"), question, buttons.Yes | buttons.No, buttons.No)
        return asked == buttons.Yes

    def _lay_out(self) -> None:
        self.setWindowTitle("tumble")
        for screen in self._in_order:
            self._screens.addWidget(ScreenArea(screen))
        middle = QWidget()
        across = QHBoxLayout()
        across.addWidget(self._navigation)
        across.addWidget(self._screens, stretch=1)
        down = QVBoxLayout(middle)
        down.setContentsMargins(0, 0, 0, 0)
        down.addLayout(across, stretch=1)
        down.addWidget(self.stop_bar)
        self.setCentralWidget(middle)

    def _connect(self) -> None:
        QShortcut(QKeySequence("Esc"), self, self.worker.stop, context=Qt.ShortcutContext.ApplicationShortcut)
        self._navigation.chosen.connect(self._screens.setCurrentIndex)
        self.stop_bar.stop_wanted.connect(self.worker.stop)
        self.worker.working.connect(self._show_working)
        self.worker.head_seen.connect(self.stop_bar.show_head)
        self.worker.connected.connect(lambda identity: self.stop_bar.show_head(identity.status))
        self.worker.disconnected.connect(lambda: self.stop_bar.show_head(None))
        self.bridge.head_seen.connect(self._show_head)
        self.background.busy.connect(self.stop_bar.show_busy)
        self.background.failed.connect(self._show_failure)
        self.stand.chosen.connect(self._use_stand)
        self.stand.refused.connect(self._show_failure)
        self.run.refused.connect(self._show_failure)
        self.run.state_changed.connect(self.stop_bar.state.setText)
        self.run.concluded.connect(self._show_result)
        self.result.experiment_wanted.connect(self._begin)
        self.result.refused.connect(self._show_failure)
        self.records.opened.connect(self._show_result)
        self.records.resume_wanted.connect(self._begin)
        self.records.refused.connect(self._show_failure)

    def _show_failure(self, error: Exception) -> None:
        self.tell(error)

    def _show_head(self, status: HeadStatus) -> None:
        self.stop_bar.show_head(status)

    def _show_working(self, working: bool) -> None:
        self._working = working
        self.result.allow_runs(not working)
        self.records.allow_runs(not working)
        if self._leaving and not working:
            self.close()

    def _use_stand(self, loaded: LoadedStand) -> None:
        self.run.use_stand(loaded, self.stand.attendant)
        self.result.use_stand(loaded)

    def _begin(self, activity: object, points: tuple[object, ...] = ()) -> None:
        self.open(self.run)
        self.run.begin(activity, points)  # type: ignore[arg-type]  # signals carry objects

    def _show_result(self, concluded: Concluded) -> None:
        self.result.show_result(concluded, self.store)
        self.records.refresh()
        self.open(self.result)

    def _restore(self) -> None:
        self.resize(*_SIZE)
        settings = QSettings()
        geometry = settings.value("window/geometry")
        if isinstance(geometry, QByteArray):
            self.restoreGeometry(geometry)
        self._navigation.choose(int(str(settings.value("window/screen", 0))))

    def _remember(self) -> None:
        QSettings().setValue("window/geometry", self.saveGeometry())
        QSettings().setValue("window/screen", self._navigation.current)
