"""The queue: which units are measured next, and what became of those before."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.look.verdicts import verdict_mark
from tumble.window.widgets.action_menu import ActionButton
from tumble.window.widgets.table import Ink, Table
from tumble.window.work.run_queue import UNDER_WAY, Entry, Stage


class QueueView(QWidget):
    """A line for each run, in their order; what can be done with a line is in its menu, and has a key."""

    move_wanted = Signal(str, int)
    """Id of an entry, and by how many places."""
    remove_wanted = Signal(str)
    """Id of an entry."""
    clear_wanted = Signal()
    record_wanted = Signal(str)
    """Id of a record."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._entries: Sequence[Entry] = ()
        self.table = Table((tr("unit"), tr("lot"), tr("programme"), tr("run"), tr("operator"), tr("state")))
        self.table.keep_narrow(0, 1, 4)
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self.table.setAccessibleName(tr("Queue"))
        self.said = PlainLabel()
        self.said.setObjectName("heading")
        self.said.setWordWrap(True)
        self._opening = self.table.offer(tr("Open the record"), self._open)
        self.up_button = ActionButton(self.table.offer(tr("&Up"), partial(self._move, -1), "Alt+Up"))
        self.down_button = ActionButton(self.table.offer(tr("&Down"), partial(self._move, 1), "Alt+Down"))
        self.remove_button = ActionButton(self.table.offer(tr("Re&move"), self._remove, "Del"))
        self.clear_button = ActionButton(self.table.offer(tr("Clea&r"), self.clear_wanted.emit))
        self._lay_out()
        self.table.itemActivated.connect(lambda _: self._opening.trigger())
        self.table.itemSelectionChanged.connect(self._refresh)
        self._refresh()

    def show_entries(self, entries: Sequence[Entry]) -> None:
        """Show the queue as it is now; the line that was chosen stays so, wherever it is."""
        chosen = self.chosen
        self._entries = tuple(entries)
        self.table.blockSignals(True)
        self.table.fill([_line(entry) for entry in entries], [_ink(entry) for entry in entries])
        self.table.clearSelection()
        for row, entry in enumerate(entries):
            if chosen is not None and entry.id == chosen.id:
                self.table.selectRow(row)
        self.table.blockSignals(False)
        self._refresh()

    def say(self, text: str) -> None:
        """Say how the queue stands."""
        self.said.setText(text)
        self.said.setVisible(bool(text))

    @property
    def chosen(self) -> Entry | None:
        """The entry of the line that is chosen."""
        rows = self.table.chosen
        return self._entries[rows[0]] if rows and rows[0] < len(self._entries) else None

    def _lay_out(self) -> None:
        buttons = QHBoxLayout()
        for button in (self.up_button, self.down_button, self.remove_button, self.clear_button):
            buttons.addWidget(button)
        buttons.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.said)
        layout.addWidget(self.table, stretch=1)
        layout.addLayout(buttons)

    def _refresh(self) -> None:
        chosen = self.chosen
        waits = chosen is not None and chosen.stage is Stage.WAITING
        for button in (self.up_button, self.down_button):
            button.action.setEnabled(waits)
        self._opening.setEnabled(chosen is not None and bool(chosen.record_id))
        self.remove_button.action.setEnabled(chosen is not None and chosen.stage not in UNDER_WAY)
        self.clear_button.action.setEnabled(any(entry.stage not in UNDER_WAY for entry in self._entries))

    def _move(self, places: int) -> None:
        if self.chosen is not None:
            self.move_wanted.emit(self.chosen.id, places)

    def _remove(self) -> None:
        if self.chosen is not None:
            self.remove_wanted.emit(self.chosen.id)

    def _open(self) -> None:
        if self.chosen is not None and self.chosen.record_id:
            self.record_wanted.emit(self.chosen.record_id)


def _line(entry: Entry) -> tuple[str, ...]:
    run = f"{entry.repeat} / {entry.repeats}" if entry.repeats > 1 else ""
    programme = Path(entry.programme).stem if entry.programme.endswith(".toml") else entry.programme
    return entry.serial_number, entry.lot, programme, run, entry.operator, stage_text(entry)


def stage_text(entry: Entry) -> str:
    """How far an entry is, in a word or two after a sign, and why it failed."""
    if entry.outcome is not None:
        return verdict_mark(entry.outcome)
    text = {
        Stage.WAITING: tr("○ waiting"),
        Stage.MOUNTING: tr("◐ mounting"),
        Stage.MEASURING: tr("▶ measuring"),
        Stage.ANALYSING: tr("◌ analysing"),
        Stage.JUDGED: tr("✓ recorded"),
        Stage.FAILED: tr("✗ failed"),
        Stage.STOPPED: tr("■ stopped"),
    }[entry.stage]
    return f"{text}: {in_language(entry.said)}" if entry.said else text


def _ink(entry: Entry) -> Ink | None:
    if entry.stage in UNDER_WAY:
        return "now"
    if entry.stage is Stage.FAILED or (entry.outcome is not None and not entry.outcome.good):
        return "bad"
    return None
