"""Runs that came to no record, and going on with one of them."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from tumble.window.look.language import tr
from tumble.window.look.sentences import in_language
from tumble.window.widgets.motion_button import MotionButton
from tumble.window.widgets.table import Table

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff


class CutOffView(QWidget):
    """A table, and a button that goes on with the run that is chosen."""

    resume_wanted = Signal(object)
    """Path of the recording."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._runs: tuple[CutOff, ...] = ()
        self._allowed = True
        self.table = Table((tr("unit"), tr("method"), tr("programme"), tr("points"), tr("ended"), tr("recording")))
        self.resume_button = MotionButton(tr("Go on with it"), "F7")
        self.resume_button.clicked.connect(self._resume)
        self.table.itemSelectionChanged.connect(self._refresh)
        layout = QVBoxLayout(self)
        layout.addWidget(self.table, stretch=1)
        layout.addWidget(self.resume_button)

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
        self.resume_button.setEnabled(self._allowed and len(self.table.chosen) == 1)

    def _resume(self) -> None:
        for row in self.table.chosen[:1]:
            self.resume_wanted.emit(self._runs[row].path)
