"""What is connected: who the instruments say they are, and until when their certificates hold."""

from datetime import UTC, datetime, timedelta
from typing import Final

from PySide6.QtCore import QDate, QLocale, Qt
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QWidget

from tumble.app.stand import LoadedStand
from tumble.drivers.protocols import Identity
from tumble.drivers.tables import Instrument
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel

_SOON: Final = timedelta(days=30)


class InstrumentTable(QFrame):
    """Head and DAQ beside each other, one line for each thing that is known."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self._grid = QGridLayout(self)
        self._cells: dict[tuple[str, str], QLabel] = {}
        names = {
            "driver": tr("Driver"),
            "address": tr("Address"),
            "model": tr("Model"),
            "serial": tr("Serial number"),
            "firmware": tr("Firmware"),
            "certificate": tr("Certificate"),
            "due": tr("Calibration due"),
        }
        for column, (key, title) in enumerate({"head": tr("Dividing head"), "daq": tr("Voltmeter")}.items(), 1):
            heading = QLabel(title)
            heading.setObjectName("heading")
            self._grid.addWidget(heading, 0, column)
            self._grid.setColumnStretch(column, 1)
            for row, name in enumerate(names, 1):
                self._cells[key, name] = self._cell(row, column)
        for row, title in enumerate(names.values(), 1):
            label = QLabel(title)
            label.setObjectName("pale")
            self._grid.addWidget(label, row, 0)

    def show_stand(self, loaded: LoadedStand) -> None:
        """Show what the stand file says."""
        self._show_file("head", loaded.file.head)
        self._show_file("daq", loaded.file.daq)
        for key in ("head", "daq"):
            self.show_identity(key, None)

    def show_identity(self, key: str, identity: Identity | None) -> None:
        """Show who answers as `head` or `daq`; None where nobody was asked."""
        for name in ("model", "serial", "firmware"):
            self._say(key, name, getattr(identity, name) if identity else "")

    def text(self, key: str, name: str) -> str:
        """What a cell says."""
        return self._cells[key, name].text()

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
