"""A run that came to no end, offered where the person stands."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout, QWidget

from tumble.messages import AsWritten, Message
from tumble.window.look.language import tr
from tumble.window.look.moments import moment_text
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.folding_row import FoldingRow, buttons_beside
from tumble.window.widgets.motion_button import MotionButton

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff


class ResumeOffer(QFrame):
    """What is known of the run, and a key that goes on with it."""

    wanted = Signal(object)
    """Path of the recording."""
    analysis_wanted = Signal(object)
    """The same, to be analysed as far as it goes."""
    discard_wanted = Signal(object)
    """The same, of no use to anybody."""

    offered = Signal(bool)
    """Whether there is something to choose."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("question")
        self._run: CutOff | None = None
        self._declined: set[Path] = set()
        """Not now."""
        self._text = PlainLabel()
        self._text.setWordWrap(True)
        self.button = MotionButton(tr("Resume"), "F7")
        self.button.setObjectName("primary")
        self.button.clicked.connect(self._want)
        self.analyse_button = _button(tr("A&nalyse"), self._want_analysis)
        self.analyse_button.setToolTip(tr("What there is of it becomes a record that says so."))
        self.discard_button = _button(tr("Dis&card…"), self._want_discarding)
        self.discard_button.setToolTip(tr("Its files are moved aside, and not deleted."))
        self.later_button = _button(tr("Not no&w"), self._decline)
        buttons = (self.button, self.analyse_button, self.discard_button, self.later_button)
        QVBoxLayout(self).addWidget(FoldingRow((self._text, buttons_beside(buttons))))

    def text(self) -> str:
        """What it says."""
        return self._text.text()

    def offer(self, runs: "Sequence[CutOff]") -> None:
        """Offer the newest of some runs, the last of them, unless it was declined; nothing where there is none."""
        wanted = [run for run in runs if run.path not in self._declined]
        if wanted:
            self._show(wanted[-1])
        self._reveal(bool(wanted))

    def withdraw(self) -> None:
        """Offer nothing any more."""
        self._reveal(False)

    def _reveal(self, shown: bool) -> None:
        self.setVisible(shown)
        self.offered.emit(shown)

    def allow(self, free: bool) -> None:
        """Whether the stand is free to go on with it."""
        self.button.setEnabled(free)

    def _show(self, run: "CutOff") -> None:
        self._run = run
        self._text.setText(
            in_language(
                Message.counted(
                    "Stopped: unit {unit}, programme {programme}, {count} point done at the stand {stand}, begun "
                    "{when}: {why}.",
                    "Stopped: unit {unit}, programme {programme}, {count} points done at the stand {stand}, begun "
                    "{when}: {why}.",
                    unit=AsWritten(run.serial_number),
                    programme=AsWritten(run.programme_name),
                    count=run.points,
                    stand=AsWritten(run.stand_name),
                    when=moment_text(run.began_at),
                    why=in_language(run.ending) or tr("it broke off"),
                )
            )
        )

    def _decline(self) -> None:
        if self._run is not None:
            self._declined.add(self._run.path)
        self.withdraw()

    def _want_analysis(self) -> None:
        if self._run is not None:
            self.analysis_wanted.emit(self._run.path)

    def _want_discarding(self) -> None:
        if self._run is not None:
            self.discard_wanted.emit(self._run.path)

    def _want(self) -> None:
        if self._run is not None:
            self.wanted.emit(self._run.path)


def _button(text: str, do: Callable[[], None]) -> QPushButton:
    button = QPushButton(text)
    button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    button.clicked.connect(do)
    return button
