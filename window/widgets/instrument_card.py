"""One instrument of a stand: whether it answers, until when its calibration holds, what it reads, and who it is."""

from collections.abc import Sequence
from datetime import UTC, date, datetime, timedelta
from typing import Final

from PySide6.QtCore import QDate, QLocale, Qt
from PySide6.QtGui import QAction, QContextMenuEvent, QGuiApplication, QKeySequence
from PySide6.QtWidgets import QFormLayout, QFrame, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from tumble.drivers.protocols import Identity
from tumble.drivers.tables import Instrument
from tumble.window.look.language import tr
from tumble.window.look.names import instrument_name
from tumble.window.look.plain import PlainLabel
from tumble.window.widgets.action_menu import open_menu
from tumble.window.widgets.lamp import Lamp, Light
from tumble.window.widgets.live_value import LiveValue

_SOON: Final = timedelta(days=30)
_NONE: Final = "—"
_EDGE_PX: Final = 6
"""Around what a card says."""


class InstrumentCard(QFrame):
    """Lamps with their words on top; reached by Tab, and copied as text by the key that copies.

    Its menu has that, and the actions of its stand that are `offered`.
    """

    def __init__(
        self, name: str, *, reads: bool, offered: Sequence[QAction] = (), parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._title = instrument_name(name)
        self.link, self.calibration = SaidLamp(), SaidLamp()
        self.live = LiveValue() if reads else None
        self._facts = QFormLayout()
        self._cells: dict[str, QLabel] = {}
        self._titles = {
            "model": tr("Model"),
            "serial": tr("Serial number"),
            "firmware": tr("Firmware"),
            "certificate": tr("Certificate"),
            "driver": tr("Driver"),
            "address": tr("Address"),
        }
        self._lay_out()
        copying = QAction(tr("Copy"), self)
        copying.setShortcut(QKeySequence.StandardKey.Copy)
        copying.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        copying.triggered.connect(self._copy)
        self.addActions([copying, *offered])

    def show_table(self, table: Instrument) -> None:
        """Show what the stand file says."""
        self._say("driver", table.driver)
        self._say_if_any("address", table.address)
        self._say_if_any("certificate", table.certificate)
        self.calibration.say(*calibration(table, datetime.now(tz=UTC).date()))
        self._name()

    def show_identity(self, identity: Identity | None) -> None:
        """Show who answers; None where nobody was asked."""
        for name in ("model", "serial", "firmware"):
            self._say(name, getattr(identity, name) if identity else "")
        self.link.say(*((Light.GOOD, tr("connected")) if identity else (Light.UNKNOWN, tr("not connected"))))
        self._name()

    def show_fault(self) -> None:
        """Show that it failed."""
        self.link.say(Light.BAD, tr("fault"))
        self._name()

    def text(self, name: str) -> str:
        """What a cell says."""
        return self._cells[name].text()

    def cell(self, name: str) -> QLabel:
        """Where something is said."""
        return self._cells[name]

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:  # noqa: N802  # Qt's name
        """Show what can be done."""
        open_menu(self, event)

    def _copy(self) -> None:
        """Everything that it says."""
        QGuiApplication.clipboard().setText("\n".join(self._lines()))

    def _lines(self) -> list[str]:
        facts = [f"{title}: {self.text(name)}" for name, title in self._titles.items()]
        read = [self.live.said.text()] if self.live is not None else []
        return [self._title, self.link.text(), self.calibration.text(), *read, *facts]

    def _name(self) -> None:
        """Say to a screen reader what the lamps say."""
        self.setAccessibleName(", ".join((self._title, self.link.text(), self.calibration.text())))

    def _lay_out(self) -> None:
        column, top = QVBoxLayout(self), QHBoxLayout()
        column.setContentsMargins(_EDGE_PX, _EDGE_PX, _EDGE_PX, _EDGE_PX)
        top.addWidget(_label(self._title, "heading"), stretch=1)
        top.addWidget(self.link)
        self._facts.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        if self.live is not None:
            self._facts.addRow(_label(tr("Reads"), "pale"), self.live)
        for name, title in self._titles.items():
            cell = self._cells[name] = _label(_NONE, "")
            cell.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            cell.setContextMenuPolicy(Qt.ContextMenuPolicy.NoContextMenu)  # that of the card
            self._facts.addRow(_label(title, "pale"), cell)
        column.addLayout(top)
        column.addWidget(self.calibration)
        column.addLayout(self._facts)
        column.addStretch(1)

    def _say(self, name: str, text: str) -> None:
        self._cells[name].setText(text or _NONE)

    def _say_if_any(self, name: str, text: str) -> None:
        """Say what a stand file may leave out; then it takes no room."""
        self._say(name, text)
        self._facts.setRowVisible(self._cells[name], bool(text))


class SaidLamp(QWidget):
    """A lamp, and beside it what it says."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.lamp, self._said = Lamp(), PlainLabel()
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.lamp)
        row.addWidget(self._said, stretch=1)

    def say(self, light: Light, text: str) -> None:
        """Say something else."""
        self.lamp.show_light(light)
        self._said.setText(text)

    def text(self) -> str:
        """What it says."""
        return self._said.text()


def calibration(table: Instrument, today: date) -> tuple[Light, str]:
    """What is to be said on a day of the calibration of an instrument."""
    due = table.calibration_due
    if due is None:
        return Light.UNKNOWN, tr("Calibration: no due date stated")
    written = QLocale().toString(QDate(due.year, due.month, due.day), QLocale.FormatType.ShortFormat)
    if table.overdue(today):
        return Light.BAD, tr("Calibration overdue since {date}", date=written)
    if due - today < _SOON:
        return Light.SOON, tr("Calibration soon due: {date}", date=written)
    return Light.GOOD, tr("Calibration valid until {date}", date=written)


def _label(text: str, kind: str) -> QLabel:
    label = PlainLabel(text)
    label.setObjectName(kind)
    return label
