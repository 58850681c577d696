"""What records are looked for."""

from datetime import UTC, datetime, timedelta
from typing import Final

from PySide6.QtCore import QDate, Signal
from PySide6.QtWidgets import QComboBox, QDateEdit, QGridLayout, QLabel, QLineEdit, QWidget

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.records.wanted import Wanted
from tumble.window.look.language import tr

_LEAST: Final = timedelta(microseconds=1)
"""By which moments of records differ."""


class RecordSearch(QWidget):
    """Serial number, programme, verdict, first and last day; everything that is left alone matches all."""

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.serial, self.programme, self.verdict = QLineEdit(), QComboBox(), QComboBox()
        self.serial.setClearButtonEnabled(True)
        self.since, self.until = self._day(), self._day()
        self.programme.addItem(tr("any"), "")
        self.verdict.addItem(tr("any"), None)
        names = {
            Outcome.PASS: tr("inside"),
            Outcome.FAIL: tr("outside"),
            Outcome.NOT_DECIDED: tr("not decided"),
            Outcome.NO_LIMITS: tr("not judged"),
        }
        for verdict, name in names.items():
            self.verdict.addItem(name, verdict)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        parts: tuple[tuple[str, QWidget], ...] = (
            (tr("&Serial number"), self.serial),
            (tr("&Programme"), self.programme),
            (tr("Ver&dict"), self.verdict),
            (tr("Fro&m"), self.since),
            (tr("&Until"), self.until),
        )
        for column, (title, field) in enumerate(parts):
            label = QLabel(title)
            label.setBuddy(field)
            grid.addWidget(label, 0, column)
            grid.addWidget(field, 1, column)
        grid.setColumnStretch(0, 1)
        self.serial.textChanged.connect(self.changed)
        self.programme.currentIndexChanged.connect(self.changed)
        self.verdict.currentIndexChanged.connect(self.changed)
        self.since.dateChanged.connect(self.changed)
        self.until.dateChanged.connect(self.changed)

    def wanted(self) -> Wanted:
        """What is asked for."""
        return Wanted(
            part_of_serial_number=self.serial.text().strip(),
            programme_name=self.programme.currentData() or "",
            verdict=self.verdict.currentData(),
            since=None if (first := _chosen(self.since)) is None else _beginning(first),
            until=None if (last := _chosen(self.until)) is None else _beginning(last.addDays(1)) - _LEAST,
        )

    def offer(self, programmes: tuple[str, ...]) -> None:
        """Offer programmes of which there are records."""
        for name in programmes:
            if self.programme.findData(name) < 0:
                self.programme.addItem(name, name)

    def _day(self) -> QDateEdit:
        field = _Day()
        field.setCalendarPopup(True)
        field.setMinimumDate(QDate(2000, 1, 1))
        field.setSpecialValueText(tr("any"))
        field.setDate(field.minimumDate())
        return field


class _Day(QDateEdit):
    """A day, or any; the first step from any is today."""

    def stepBy(self, steps: int) -> None:  # noqa: N802  # Qt's name
        """Go on by days, months or years."""
        if self.date() == self.minimumDate():
            self.setDate(QDate.currentDate())
        else:
            super().stepBy(steps)

    def focusNextPrevChild(self, forwards: bool) -> bool:  # noqa: N802  # Qt's name
        """Leave the field: Qt would go on to the month of a day that is none, and never come out."""
        return QWidget.focusNextPrevChild(self, forwards)


def _chosen(field: QDateEdit) -> QDate | None:
    """The day in a field; None for any."""
    return None if field.date() == field.minimumDate() else field.date()


def _beginning(day: QDate) -> datetime:
    """When a day begins on the desktop, also where its first hour is left out or comes twice."""
    return datetime.fromtimestamp(day.startOfDay().toSecsSinceEpoch(), UTC)
