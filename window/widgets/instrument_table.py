"""What is connected: who the instruments say they are, and until when their certificates hold."""

from collections.abc import Collection
from datetime import UTC, datetime, timedelta
from typing import Final

from PySide6.QtCore import QDate, QLocale, Qt
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QWidget

from tumble.app.stand import LoadedStand
from tumble.drivers.protocols import Block, Identity
from tumble.drivers.tables import Instrument
from tumble.window.look.language import tr
from tumble.window.look.names import instrument_name
from tumble.window.look.plain import PlainLabel
from tumble.window.widgets.live_value import LiveValue

_SOON: Final = timedelta(days=30)


class InstrumentTable(QFrame):
    """The instruments of a stand beside each other, one line for each thing that is known."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self._grid = QGridLayout(self)
        self._instruments: tuple[str, ...] = ()
        self._cells: dict[tuple[str, str], QLabel] = {}
        self.live: dict[str, LiveValue] = {}
        """What the samplers read, by name."""
        self._titles = {
            "driver": tr("Driver"),
            "address": tr("Address"),
            "model": tr("Model"),
            "serial": tr("Serial number"),
            "firmware": tr("Firmware"),
            "certificate": tr("Certificate"),
            "due": tr("Calibration due"),
        }

    def show_stand(self, loaded: LoadedStand) -> None:
        """Show what the stand file says."""
        tables, samplers = loaded.file.instruments, tuple(loaded.file.samplers)
        if (tuple(tables), samplers) != (self._instruments, tuple(self.live)):
            self._make(tuple(tables), samplers)
        for key, table in tables.items():
            self._show_file(key, table)
        self.forget_identities()

    def show_identity(self, key: str, identity: Identity | None) -> None:
        """Show who answers as an instrument; None where nobody was asked. One of another stand is passed over."""
        if key not in self._instruments:
            return
        for name in ("model", "serial", "firmware"):
            self._say(key, name, getattr(identity, name) if identity else "")

    def forget_identities(self) -> None:
        """Nobody was asked."""
        for key in self._instruments:
            self.show_identity(key, None)
        for live in self.live.values():
            live.forget()

    def see(self, key: str, block: Block | None) -> None:
        """Show what a sampler reads; None where it gives no samples."""
        if key in self.live:
            self.live[key].see(block)

    def pause_readings(self) -> None:
        """Nothing is read for a while."""
        for live in self.live.values():
            live.pause()

    def text(self, key: str, name: str) -> str:
        """What a cell says."""
        return self._cells[key, name].text()

    def _make(self, instruments: tuple[str, ...], samplers: Collection[str]) -> None:
        """A column for each instrument, in place of those that are there."""
        while (item := self._grid.takeAt(0)) is not None:
            if (before := item.widget()) is not None:
                before.hide()  # it is deleted when the event loop comes to it
                before.deleteLater()
        for column in range(self._grid.columnCount()):
            self._grid.setColumnStretch(column, 0)
        self._instruments = instruments
        for row, title in enumerate(self._titles.values(), 1):
            self._grid.addWidget(_label(title, "pale"), row, 0)
        for column, key in enumerate(instruments, 1):
            self._grid.addWidget(_label(instrument_name(key), "heading"), 0, column)
            self._grid.setColumnStretch(column, 1)
            self._cells |= {(key, name): self._cell(row, column) for row, name in enumerate(self._titles, 1)}
        below = len(self._titles) + 1
        self._grid.addWidget(_label(tr("Reads"), "pale"), below, 0)
        self.live = {key: LiveValue() for key in samplers}
        for key, live in self.live.items():
            self._grid.addWidget(live, below, 1 + instruments.index(key))

    def _cell(self, row: int, column: int) -> QLabel:
        label = PlainLabel()
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._grid.addWidget(label, row, column)
        return label

    def _show_file(self, key: str, table: Instrument) -> None:
        self._say(key, "driver", table.driver)
        self._say(key, "address", table.address)
        self._say(key, "certificate", table.certificate)
        due, today = table.calibration_due, datetime.now(tz=UTC).date()
        if due is None:
            self._say(key, "due", "")
            return
        written = QLocale().toString(QDate(due.year, due.month, due.day), QLocale.FormatType.ShortFormat)
        if table.overdue(today):
            self._say(key, "due", tr("✗ {date}: overdue", date=written), "bad")
        elif due - today < _SOON:
            self._say(key, "due", tr("⚠ {date}: soon", date=written), "bad")
        else:
            self._say(key, "due", tr("✓ {date}", date=written), "good")

    def _say(self, key: str, name: str, text: str, kind: str = "") -> None:
        label = self._cells[key, name]
        label.setText(text or "—")
        label.setObjectName(kind)
        label.style().polish(label)


def _label(text: str, kind: str) -> QLabel:
    label = PlainLabel(text)
    label.setObjectName(kind)
    return label
