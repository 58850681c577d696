"""What records are looked for."""

from collections.abc import Iterable, Mapping
from datetime import UTC, datetime, timedelta
from types import MappingProxyType
from typing import Final

from PySide6.QtCore import QDate, Qt, Signal
from PySide6.QtWidgets import QComboBox, QDateEdit, QGridLayout, QLabel, QLineEdit, QStyle, QVBoxLayout, QWidget

from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.records.wanted import Wanted
from tumble.window.look.language import tr
from tumble.window.look.sentences import in_language
from tumble.window.widgets.folding_row import FoldingRow

_LEAST: Final = timedelta(microseconds=1)
"""By which moments of records differ."""
_NAME: Final = 8
"""Letters."""
_NOTHING: Final = "-"
"""Chosen to look for records in which no effect was found; no effect has this name."""


class RecordSearch(QWidget):
    """What a record says in the columns of the list, first and last day; everything that is left alone matches all."""

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.serial, self.lot, self.verdict = QLineEdit(), QLineEdit(), QComboBox()
        self.programme, self.stand, self.method, self.finding = _Names(), _Names(), _Names(), _Names()
        self.finding.addItem(tr("none"), _NOTHING)
        for field in (self.serial, self.lot):
            field.setClearButtonEnabled(True)
            field.textChanged.connect(self.changed)
        self.since, self.until = self._day(), self._day()
        self.verdict.addItem(tr("any"), None)
        names = {
            Outcome.PASS: tr("inside"),
            Outcome.FAIL: tr("outside"),
            Outcome.NOT_DECIDED: tr("not decided"),
            Outcome.NO_LIMITS: tr("not judged"),
        }
        for verdict, name in names.items():
            self.verdict.addItem(name, verdict)
        origin = (
            (tr("&Serial number"), self.serial),
            (tr("Lot"), self.lot),
            (tr("&Programme"), self.programme),
            (tr("Sta&nd"), self.stand),
            (tr("Method"), self.method),
        )
        outcome = (
            (tr("Ver&dict"), self.verdict),
            (tr("Effect"), self.finding),
            (tr("Fro&m"), self.since),
            (tr("&Until"), self.until),
        )
        row = QVBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(FoldingRow((_titled(origin), _titled(outcome))))
        for box in (self.programme, self.stand, self.method, self.verdict, self.finding):
            box.currentIndexChanged.connect(self.changed)
        self.since.dateChanged.connect(self.changed)
        self.until.dateChanged.connect(self.changed)

    def wanted(self) -> Wanted:
        """What is asked for."""
        return Wanted(
            part_of_serial_number=self.serial.text().strip(),
            part_of_lot=self.lot.text().strip(),
            programme_name=self.programme.currentData(),
            stand_name=self.stand.currentData(),
            method=self.method.currentData(),
            verdict=self.verdict.currentData(),
            finding=_finding(self.finding.currentData()),
            since=None if (first := _chosen(self.since)) is None else _beginning(first),
            until=None if (last := _chosen(self.until)) is None else _beginning(last.addDays(1)) - _LEAST,
        )

    def _day(self) -> QDateEdit:
        field = _Day()
        field.setCalendarPopup(True)
        field.setMinimumDate(QDate(2000, 1, 1))
        field.setSpecialValueText(tr("any"))
        field.setDate(field.minimumDate())
        return field


def _finding(chosen: str) -> str | None:
    """What `Wanted` calls what was chosen among effects."""
    return "" if chosen == _NOTHING else chosen or None


class _Names(QComboBox):
    """One of several names, or any; no wider than a name, its list as wide as what these are called in words."""

    def __init__(self) -> None:
        super().__init__()
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(_NAME)
        self.addItem(tr("any"), "")

    def offer(self, names: Iterable[str], words: Mapping[str, str] = MappingProxyType({})) -> None:
        """Offer names, too; `words` are what those are called that are no words themselves."""
        for name in names:
            if self.findData(name) < 0:
                self.addItem(in_language(words.get(name, name)), name)
        bar = self.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
        self.view().setMinimumWidth(self.view().sizeHintForColumn(0) + bar)


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


def _titled(fields: Iterable[tuple[str, QWidget]]) -> QWidget:
    """Fields beside each other, each below its title; those to type in, or else the first, take what room there is."""
    fields, together = tuple(fields), QWidget()
    grid = QGridLayout(together)
    grid.setContentsMargins(0, 0, 0, 0)
    for column in [place for place, (_, field) in enumerate(fields) if isinstance(field, QLineEdit)] or [0]:
        grid.setColumnStretch(column, 1)
    grid.setRowStretch(1, 1)  # titles are in one line with those of fields that are higher
    for column, (title, field) in enumerate(fields):
        label = QLabel(title)
        label.setBuddy(field)
        grid.addWidget(label, 0, column)
        grid.addWidget(field, 1, column, Qt.AlignmentFlag.AlignVCenter)
    return together


def _chosen(field: QDateEdit) -> QDate | None:
    """The day in a field; None for any."""
    return None if field.date() == field.minimumDate() else field.date()


def _beginning(day: QDate) -> datetime:
    """When a day begins on the desktop, also where its first hour is left out or comes twice."""
    return datetime.fromtimestamp(day.startOfDay().toSecsSinceEpoch(), UTC)
