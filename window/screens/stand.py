"""The screen Stand: what is connected, where the head is, and turning it."""

from collections.abc import Callable
from html import escape
from pathlib import Path

from PySide6.QtCore import QSettings, Qt, Signal
from PySide6.QtGui import QAction, QHideEvent, QShowEvent
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from tumble.app.stand import LoadedStand, load_stand
from tumble.app.wiring import Attendant
from tumble.drivers.errors import DeviceError, LimitError
from tumble.drivers.protocols import Block, Identity, PositionerStatus
from tumble.procedures.errors import InputError
from tumble.procedures.events import Event, Identified
from tumble.procedures.first_method import FIRST
from tumble.window.kept import kept_text
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.screens.stand_editor import StandEditor
from tumble.window.widgets.action_menu import ActionButton
from tumble.window.widgets.column import Column
from tumble.window.widgets.dialog import FileDialog
from tumble.window.widgets.dials import Dials
from tumble.window.widgets.folding_row import FoldingRow, buttons_beside
from tumble.window.widgets.instrument_cards import InstrumentCards
from tumble.window.widgets.jog import Jog
from tumble.window.widgets.simulation_settings import SimulationSettings
from tumble.window.widgets.splitter import Splitter
from tumble.window.work.bridge import EventBridge
from tumble.window.work.operator import WindowOperator
from tumble.window.work.session import StandIdentity
from tumble.window.work.stand_worker import StandWorker


class StandScreen(QWidget):
    """The stand file that is chosen, its instruments, the dial, and what turns the head."""

    refused = Signal(object)
    """An exception that the person must see."""
    dialog_wanted = Signal(object)
    """`Dialog`."""

    def __init__(
        self, worker: StandWorker, bridge: EventBridge, operator: WindowOperator, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._worker, self._operator = worker, operator
        self._connected = self._by_hand = False
        self._warnings: tuple[str, ...] = ()
        self._method = FIRST
        """Whose stand is the one that is built in."""
        self._lost: set[str] = set()
        """Positioners that do not know their angle."""
        self.connect_button = self._button(tr("&Connect"), lambda: worker.connect_to(self.attendant()))
        self.disconnect_button = self._button(tr("&Disconnect"), worker.disconnect_from)
        self.edit_button = self._button(tr("&Edit…"), self.edit)
        offered = [each.action for each in (self.connect_button, self.disconnect_button, self.edit_button)]
        self.dials, self.cards, self.jog = Dials(), InstrumentCards(offered), Jog()
        self.simulation = SimulationSettings()
        self._name, self._notice, self.editor = QLabel(), PlainLabel(), StandEditor()
        self._lay_out()
        self._connect(bridge)
        self._show_stand(self.loaded)

    def _button(self, text: str, do: Callable[[], None]) -> ActionButton:
        action = QAction(text, self)
        action.triggered.connect(lambda _checked: do())
        return ActionButton(action)

    @property
    def loaded(self) -> LoadedStand:
        """The stand file that is chosen."""
        return self._worker.session.loaded

    def attendant(self) -> Attendant:
        """Who is asked at the stand that is chosen."""
        if self.loaded.file.simulates:
            return self.simulation.attendant(self._operator)
        return Attendant(operator=lambda: self._operator, speed=1.0)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802  # Qt's name
        """Have the samplers read."""
        super().showEvent(event)
        self._worker.watch(True)

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802  # Qt's name
        """Leave them alone again, and keep no reading that grows old."""
        super().hideEvent(event)
        self._worker.watch(False)
        self.cards.pause_readings()

    def use(self, loaded: LoadedStand) -> bool:
        """Choose a stand, and leave the one before; returns whether that could be."""
        try:
            self._worker.use(loaded)
        except InputError as error:
            self.refused.emit(error)
            return False
        return True

    def suit(self, method: str) -> None:
        """Be ready for programmes of a method: where the stand is one that is built in, have that of the method."""
        self._method = method
        if self.loaded.path is not None or self._worker.busy:
            return
        built_in = load_stand(None, method)
        if built_in.file.name != self.loaded.file.name:
            self.use(built_in)

    def _show_stand(self, loaded: LoadedStand) -> None:
        place = str(loaded.path) if loaded.path else tr("the simulated stand that is built in")
        self._name.setText(f"<b>{escape(loaded.file.name)}</b><br>{escape(place)}")
        self.cards.show_stand(loaded)
        self.jog.show_positioners(tuple(loaded.file.positioners))
        self.simulation.setVisible(loaded.file.simulates)
        QSettings().setValue("stand/path", str(loaded.path) if loaded.path else "")
        self._show_disconnected()  # the one before is left, and what that tells is no longer heard

    def _connect(self, bridge: EventBridge) -> None:
        worker = self._worker
        self.simulation.changed.connect(worker.disconnect_from)
        self.jog.step_wanted.connect(worker.move_by)
        self.jog.angle_wanted.connect(worker.move_to)
        self.jog.home_wanted.connect(worker.home)
        self.jog.misunderstood.connect(lambda sentence: self.refused.emit(InputError(sentence)))
        self.editor.saved.connect(self.use)
        self.editor.left.connect(lambda: self._edit(False))
        self.editor.refused.connect(self.refused)
        self.editor.dialog_wanted.connect(self.dialog_wanted)
        worker.chosen.connect(self._show_stand)
        worker.connected.connect(self._show_connected)
        worker.disconnected.connect(self._show_disconnected)
        worker.working.connect(self._show_working)
        worker.failed.connect(self._show_fault)
        worker.broken_off.connect(self._show_fault)
        worker.position_seen.connect(self._see)
        worker.reading_seen.connect(self._see_reading)
        bridge.position_seen.connect(self._see)
        bridge.announced.connect(self._hear)

    def _lay_out(self) -> None:
        self._browse, self._built_in = QPushButton(tr("Stand &file…")), QPushButton(tr("&Built-in"))
        self._browse.clicked.connect(self._choose)
        self._built_in.clicked.connect(lambda: self.use(load_stand(None, self._method)))
        self._name.setWordWrap(True)
        self._notice.setWordWrap(True)
        self._notice.setObjectName("bad")
        files = buttons_beside((self._browse, self._built_in, self.edit_button))
        links = buttons_beside((self.connect_button, self.disconnect_button))
        facts = Column((self.cards, self.simulation, self._notice, self.jog))
        self._facts = Splitter(Qt.Orientation.Horizontal, (self.dials, facts), (1, 1))
        self.editor.hide()
        layout = QVBoxLayout(self)
        layout.addWidget(FoldingRow((self._name, files, links)))
        layout.addWidget(self._facts, stretch=1)
        layout.addWidget(self.editor, stretch=1)

    def _choose(self) -> None:
        dialog = FileDialog(tr("Stand file"), self.loaded.folder, tr("Stand files (*.toml)"))
        dialog.chosen.connect(self.open)
        self.dialog_wanted.emit(dialog)

    def open(self, path: Path) -> None:
        """Choose a stand by its file, or say what is wrong with that."""
        try:
            self.use(load_stand(path))
        except InputError as error:
            self.refused.emit(error)

    def edit(self) -> None:
        """Show the stand file as text."""
        path = self.loaded.path
        if path is None:
            return
        try:
            self.editor.open(path)
        except InputError as error:
            self.refused.emit(error)
            return
        self._edit(True)
        self.editor.text.setFocus()

    def _edit(self, wanted: bool) -> None:
        self.editor.setVisible(wanted)
        self._facts.setVisible(not wanted)
        self._refresh()

    def _show_connected(self, identity: StandIdentity) -> None:
        self._connected = True
        self._by_hand = any(status.by_hand for status in identity.statuses.values())
        self.cards.show_stand(self.loaded)  # what is due may have changed since
        for name, instrument in identity.instruments.items():
            self.cards.show_identity(name, instrument)
        self._warnings = identity.warnings
        for name, status in identity.statuses.items():
            self._see(name, status)
        self._refresh()

    def _show_disconnected(self) -> None:
        self._connected = False
        self.cards.forget_identities()
        self.dials.show_positioners(tuple(self.loaded.file.positioners))
        self._lost = set()
        self._notice.clear()
        self._refresh()

    def _show_working(self, working: bool) -> None:
        if working:
            self.cards.pause_readings()
            self.cards.forget_faults()
        self._refresh()

    def _show_fault(self, error: BaseException) -> None:
        """Show whose fault it was that ended a run, or anything else; a move that was refused is nobody's."""
        fault = error if isinstance(error, DeviceError) else error.__cause__
        if isinstance(fault, DeviceError) and not isinstance(fault, LimitError):
            self.cards.show_fault(fault.instrument)

    def _see(self, name: str, status: PositionerStatus) -> None:
        self.dials.show_status(name, status)
        self._lost = self._lost - {name} if status.referenced else self._lost | {name}
        home_first = [tr("The head does not know its angle: home it first.")] if self._lost else []
        self._notice.setText("\n".join([*map(in_language, self._warnings), *home_first]))

    def _see_reading(self, name: str, block: Block | None) -> None:
        """Show what a look saw, unless it is of the past: an order has begun since, or nobody watches any more."""
        if self.isVisible() and not self._worker.busy:
            self.cards.see(name, block)

    def _hear(self, event: Event) -> None:
        """Show who answers in a run, which asks anew whenever a link was lost."""
        if isinstance(event, Identified):
            identity = Identity(model=event.model, serial=event.serial, firmware=event.firmware)
            self.cards.show_identity(event.instrument, identity)

    def _refresh(self) -> None:
        free = not self._worker.busy
        for part in (self._browse, self._built_in, self.simulation):
            part.setEnabled(free)
        editing = not self.editor.isHidden()
        self.editor.allow(free)
        self.edit_button.action.setEnabled(free and not editing and self.loaded.path is not None)
        self.connect_button.action.setEnabled(free and not self._connected)
        self.disconnect_button.action.setEnabled(free and self._connected)
        self.jog.setEnabled(free and self._connected and not self._by_hand)


def remembered_stand() -> tuple[LoadedStand, InputError | None]:
    """The stand that was chosen last; where that is none any more, the one that is built in, and why."""
    path = kept_text("stand/path")
    try:
        return load_stand(Path(path) if path else None), None
    except InputError as error:
        return load_stand(), error
