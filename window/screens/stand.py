"""The screen Stand: what is connected, where the head is, and turning it."""

from html import escape
from pathlib import Path

from PySide6.QtCore import QSettings, Qt, Signal
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from app.stand import LoadedStand, load_stand
from app.wiring import Attendant
from procedures.errors import InputError
from window.look.plain import PlainLabel
from window.look.sentences import in_language
from window.widgets.dial import Dial
from window.widgets.instrument_table import InstrumentTable
from window.widgets.jog import Jog
from window.widgets.simulation_settings import SimulationSettings
from window.widgets.splitter import Splitter
from window.work.bridge import EventBridge
from window.work.operator import WindowOperator
from window.work.stand_worker import StandIdentity, StandWorker


class StandScreen(QWidget):
    """The stand file that is chosen, its instruments, the dial, and what turns the head."""

    chosen = Signal(object)
    """`LoadedStand`, another one than before."""
    refused = Signal(object)
    """An exception that the person must see."""

    def __init__(
        self, worker: StandWorker, bridge: EventBridge, operator: WindowOperator, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._worker, self._operator = worker, operator
        self.loaded: LoadedStand = load_stand()
        self._connected = self._by_hand = self._working = False
        self.dial, self.table, self.jog = Dial(), InstrumentTable(), Jog()
        self.simulation = SimulationSettings()
        self.connect_button, self.disconnect_button = (
            QPushButton(self.tr("&Connect")),
            QPushButton(self.tr("&Disconnect")),
        )
        self._name, self._notice = QLabel(), PlainLabel()
        self._lay_out()
        self._connect(bridge)
        self.use(self._remembered())

    def attendant(self) -> Attendant:
        """Who is asked at the stand that is chosen."""
        if self.loaded.file.simulates:
            return self.simulation.attendant(self._operator)
        return Attendant(operator=lambda: self._operator, speed=1.0)

    def use(self, loaded: LoadedStand) -> None:
        """Choose a stand; the one before is left."""
        self._worker.disconnect_from()
        self.loaded = loaded
        place = str(loaded.path) if loaded.path else self.tr("the simulated stand that is built in")
        self._name.setText(f"<b>{escape(loaded.file.name)}</b><br>{escape(place)}")
        self.table.show_stand(loaded)
        self.simulation.setVisible(loaded.file.simulates)
        QSettings().setValue("stand/path", str(loaded.path) if loaded.path else "")
        self.chosen.emit(loaded)
        self._refresh()

    def _remembered(self) -> LoadedStand:
        path = str(QSettings().value("stand/path", ""))
        try:
            return load_stand(Path(path) if path else None)
        except InputError:
            return load_stand()  # it was moved or is no stand file any more: choosing it again says why

    def _connect(self, bridge: EventBridge) -> None:
        worker = self._worker
        self.connect_button.clicked.connect(lambda: worker.connect_to(self.loaded, self.attendant()))
        self.disconnect_button.clicked.connect(worker.disconnect_from)
        self.simulation.changed.connect(worker.disconnect_from)
        self.jog.step_wanted.connect(worker.move_by)
        self.jog.angle_wanted.connect(worker.move_to)
        self.jog.home_wanted.connect(worker.home)
        self.jog.misunderstood.connect(lambda sentence: self.refused.emit(InputError(sentence)))
        worker.connected.connect(self._show_connected)
        worker.disconnected.connect(self._show_disconnected)
        worker.working.connect(self._show_working)
        worker.head_seen.connect(self.dial.show_status)
        bridge.head_seen.connect(self.dial.show_status)

    def _lay_out(self) -> None:
        browse, built_in = QPushButton(self.tr("Stand &file…")), QPushButton(self.tr("&Built-in"))
        browse.clicked.connect(self._choose)
        built_in.clicked.connect(lambda: self.use(load_stand()))
        self._name.setWordWrap(True)
        self._notice.setWordWrap(True)
        self._notice.setObjectName("bad")
        choice = QHBoxLayout()
        choice.addWidget(self._name, stretch=1)
        for button in (browse, built_in, self.connect_button, self.disconnect_button):
            choice.addWidget(button)
        facts = QWidget()
        column = QVBoxLayout(facts)
        column.setContentsMargins(0, 0, 0, 0)
        for part in (self.table, self.simulation, self._notice, self.jog):
            column.addWidget(part)
        column.addStretch(1)
        halves = Splitter(Qt.Orientation.Horizontal, (self.dial, facts), (1, 1))
        layout = QVBoxLayout(self)
        layout.addLayout(choice)
        layout.addWidget(halves, stretch=1)

    def _choose(self) -> None:
        folder = str(self.loaded.folder)
        chosen, _ = QFileDialog.getOpenFileName(self, self.tr("Stand file"), folder, self.tr("Stand files (*.toml)"))
        if chosen:
            self.open(Path(chosen))

    def open(self, path: Path) -> None:
        """Choose a stand by its file, or say what is wrong with that."""
        try:
            self.use(load_stand(path))
        except InputError as error:
            self.refused.emit(error)

    def _show_connected(self, identity: StandIdentity) -> None:
        self._connected, self._by_hand = True, identity.status.by_hand
        self.table.show_identities(identity.head, identity.daq)
        self.dial.show_status(identity.status)
        unreferenced = (
            [] if identity.status.referenced else [self.tr("The head does not know its angle: home it first.")]
        )
        self._notice.setText("\n".join([*map(in_language, identity.warnings), *unreferenced]))
        self._refresh()

    def _show_disconnected(self) -> None:
        self._connected = False
        self.table.show_identities(None, None)
        self.dial.show_status(None)
        self._notice.clear()
        self._refresh()

    def _show_working(self, working: bool) -> None:
        self._working = working
        self._refresh()

    def _refresh(self) -> None:
        self.connect_button.setEnabled(not self._connected and not self._working)
        self.disconnect_button.setEnabled(self._connected and not self._working)
        self.jog.setEnabled(self._connected and not self._working and not self._by_hand)
        self.simulation.setEnabled(not self._working)
