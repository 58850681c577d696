"""The records that were found, a row for each, with signs for verdict, effects and stand."""

from collections.abc import Collection, Mapping, Sequence
from typing import Final, TypeAlias

from PySide6.QtCore import QEvent, QItemSelectionModel, QSignalBlocker, QSize, Qt
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QWidget

from tumble.calibrations.records.record import Record
from tumble.window.look.language import tr
from tumble.window.look.plain import as_tooltip
from tumble.window.look.sentences import in_language
from tumble.window.look.signs import CORRECTED, DASH, EFFECT, SIMULATED, UNCORRECTED, UNNAMED, Sign, sign_icon
from tumble.window.look.theme import colours
from tumble.window.look.verdicts import VERDICT_SIGNS, verdict_words
from tumble.window.widgets.sortable_table import SortableTable
from tumble.window.widgets.table import Ink
from tumble.window.work.record_lines import RecordLine
from tumble.window.work.record_words import StandState

_Signs: TypeAlias = Mapping[int, tuple[Sign, str]]
"""The sign of a cell and what it says, by column."""
_UNIT, _MEASURED, _VERDICT, _EFFECTS, _STAND, _LOT = 0, 2, 3, 5, 6, 7
"""Columns."""
_STAND_SIGNS: Final = {
    StandState.CORRECTED: CORRECTED,
    StandState.UNCORRECTED: UNCORRECTED,
    StandState.SIMULATED: SIMULATED,
}


class RecordTable(SortableTable):
    """The newest on top; what a sign says stands in words in its tooltip, and is read out."""

    def __init__(self, parent: QWidget | None = None) -> None:
        headings = (
            tr("unit"),
            tr("programme"),
            tr("measured"),
            tr("verdict"),
            tr("result"),
            tr("effects"),
            tr("stand"),
            tr("lot"),
            tr("method"),
            tr("revision"),
            tr("record"),
        )
        super().__init__(headings, newest=_MEASURED, parent=parent)
        self._lines: Sequence[RecordLine] = ()
        self._signs: Sequence[_Signs] = ()
        """Of every line."""
        self.keep_narrow(_UNIT, _STAND, _LOT)
        self.setWordWrap(False)
        self._size_signs()

    def show_lines(self, lines: Sequence[RecordLine]) -> None:
        """Show other records; what was chosen and is among them stays chosen."""
        chosen = {record.id for record in self.chosen_records}
        with QSignalBlocker(self):  # nobody asks what is chosen while rows and records differ
            self.clearSelection()
            self._lines, self._signs = lines, [_signs(line) for line in lines]
            self.fill([line.cells for line in lines])
            self._choose(chosen)
        if chosen:
            self.itemSelectionChanged.emit()

    def _choose(self, ids: Collection[str]) -> None:
        select = QItemSelectionModel.SelectionFlag.Select | QItemSelectionModel.SelectionFlag.Rows
        for row in range(self.rowCount()):
            if self._lines[self.number(row)].record.id in ids:
                self.selectionModel().select(self.model().index(row, 0), select)

    @property
    def chosen_records(self) -> list[Record]:
        """Those whose rows are selected, as they were found."""
        return [self._lines[number].record for number in self.chosen]

    def sorted_by(self, text: str, row: int, column: int) -> str:
        """Moments go by their time, however a language writes them."""
        return str(self._lines[row].measured_at.timestamp()) if column == _MEASURED else text

    def write(self, rows: Sequence[Sequence[str]], inks: Sequence[Ink | None]) -> None:
        """Put texts and signs into the cells."""
        super().write(rows, inks)
        for row in range(self.rowCount()):
            for column, (_, said) in self._signs[self.number(row)].items():
                item = self.cell(row, column)
                item.setToolTip(as_tooltip(said))
                item.setData(Qt.ItemDataRole.AccessibleTextRole, said)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Paint signs as high as another size of text."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._size_signs()

    def _size_signs(self) -> None:
        edge = self.fontMetrics().height()
        self.setIconSize(QSize(edge, edge))

    def colour(self) -> None:
        """Write and paint in the colours of the window."""
        super().colour()
        self._sign()

    def _sign(self) -> None:
        icons: dict[Sign, QIcon] = {}
        for row in range(self.rowCount()):
            for column, (sign, _) in self._signs[self.number(row)].items():
                if sign not in icons:
                    icons[sign] = sign_icon(sign, colours(self))
                self.cell(row, column).setIcon(icons[sign])


def _signs(line: RecordLine) -> _Signs:
    findings, outcome = line.findings, line.record.verdict.outcome
    found = EFFECT if findings.effects else UNNAMED if findings.unnamed else DASH
    return {
        _VERDICT: (VERDICT_SIGNS[outcome], verdict_words(outcome)),
        _EFFECTS: (found, "\n".join(map(in_language, findings.lines))),
        _STAND: (_STAND_SIGNS[line.stand], line.stand_words),
    }
