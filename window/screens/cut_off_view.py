"""Runs that came to no record, and what becomes of one of them."""

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal, SignalInstance
from PySide6.QtWidgets import QVBoxLayout, QWidget

from tumble.window.look.language import tr
from tumble.window.look.sentences import in_language
from tumble.window.widgets.action_menu import ActionButton
from tumble.window.widgets.folding_row import FoldingRow, buttons_at_left, buttons_beside
from tumble.window.widgets.motion_button import MotionButton
from tumble.window.widgets.table import Table

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff


class CutOffView(QWidget):
    """A table, and buttons for the run that is chosen; its menu lacks what starts motion, since Enter chooses there."""

    resume_wanted = Signal(object)
    """Path of the recording."""
    analysis_wanted = Signal(object)
    """The same, to be analysed as far as it goes."""
    discard_wanted = Signal(object)
    """The same, of no use to anybody."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._runs: tuple[CutOff, ...] = ()
        self._allowed = True
        self.table = Table((tr("unit"), tr("method"), tr("programme"), tr("points"), tr("ended"), tr("recording")))
        self.table.keep_narrow(0)
        self.resume_button = MotionButton(tr("Go on with it"), "F7")
        self.resume_button.clicked.connect(partial(self._want, self.resume_wanted))
        self.analyse_button = self._button(tr("Analyse as it is"), self.analysis_wanted)
        self.discard_button = self._button(tr("Discard…"), self.discard_wanted)
        self.table.itemSelectionChanged.connect(self._refresh)
        others = buttons_beside((self.analyse_button, self.discard_button))
        layout = QVBoxLayout(self)
        layout.addWidget(self.table, stretch=1)
        layout.addWidget(FoldingRow((buttons_at_left((self.resume_button,)), others)))
        self._refresh()

    def _button(self, text: str, wanted: SignalInstance) -> ActionButton:
        return ActionButton(self.table.offer(text, partial(self._want, wanted)))

    def show_runs(self, runs: "tuple[CutOff, ...]", titles: Mapping[str, str]) -> None:
        """Show other runs, the newest one chosen, with the `titles` of methods by name."""
        self._runs = runs
        self.table.fill(
            [
                (
                    run.serial_number,
                    in_language(titles.get(run.method, run.method)),
                    run.programme_name,
                    str(run.points),
                    in_language(run.ending) or tr("broke off"),
                    run.path.name,
                )
                for run in runs
            ]
        )
        if runs:
            self.table.selectRow(len(runs) - 1)
        self._refresh()

    def allow_runs(self, allowed: bool) -> None:
        """Whether the stand is free."""
        self._allowed = allowed
        self._refresh()

    def _refresh(self) -> None:
        has_one = len(self.table.chosen) == 1
        self.resume_button.setEnabled(self._allowed and has_one)
        for button in (self.analyse_button, self.discard_button):
            button.action.setEnabled(has_one)

    def _want(self, wanted: SignalInstance, _checked: bool = False) -> None:
        for row in self.table.chosen[:1]:
            wanted.emit(self._runs[row].path)
