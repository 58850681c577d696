"""A run that came to no end, offered where the person stands."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QSettings, Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QWidget

from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.motion_button import MotionButton

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff


_LEFT: Final = "run/left"
_KEPT: Final = 200
"""Paths of runs that were left, the newest of them."""


class ResumeOffer(QFrame):
    """What is known of the run, and a key that goes on with it."""

    wanted = Signal(object)
    """Path of the recording."""
    analysis_wanted = Signal(object)
    """The same, to be analysed as far as it goes."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("question")
        self._run: CutOff | None = None
        self._declined: set[Path] = set()
        """Not now."""
        self._text = PlainLabel()
        self._text.setWordWrap(True)
        self.button = MotionButton(tr("Go on with it"), "F7")
        self.button.setObjectName("primary")
        self.button.clicked.connect(self._want)
        self.analyse_button = _button(tr("Analyse what there is"), self._want_analysis)
        self.later_button = _button(tr("Not now"), self._decline)
        self.leave_button = _button(tr("Leave it"), self._leave)
        self.leave_button.setToolTip(tr("It is not offered again; the recording is kept, and listed in Records."))
        layout = QHBoxLayout(self)
        layout.addWidget(self._text, stretch=1)
        for button in (self.button, self.analyse_button, self.later_button, self.leave_button):
            layout.addWidget(button)

    def text(self) -> str:
        """What it says."""
        return self._text.text()

    def offer(self, runs: "Sequence[CutOff]") -> None:
        """Offer the newest of some runs, the last of them, unless it was declined; nothing where there is none."""
        passed_over = self._declined | {Path(path) for path in _left()}
        wanted = [run for run in runs if run.path not in passed_over]
        if wanted:
            self._show(wanted[-1])
        self.setVisible(bool(wanted))

    def _show(self, run: "CutOff") -> None:
        self._run, began_at = run, f"{run.began_at.astimezone():%Y-%m-%d %H:%M}"
        self._text.setText(
            tr(
                "Not at its end: unit {unit}, programme {programme}, {points} points done at the stand {stand}, "
                "begun {when}: {why}.",
                unit=run.serial_number,
                programme=run.programme_name,
                points=run.points,
                stand=run.stand_name,
                when=began_at,
                why=in_language(run.ending) or tr("it broke off"),
            )
        )

    def _decline(self) -> None:
        if self._run is not None:
            self._declined.add(self._run.path)
        self.hide()

    def _leave(self) -> None:
        """Never offer it again."""
        if self._run is not None:
            QSettings().setValue(_LEFT, [*_left(), str(self._run.path)][-_KEPT:])
        self._decline()

    def _want_analysis(self) -> None:
        if self._run is not None:
            self.analysis_wanted.emit(self._run.path)

    def _want(self) -> None:
        if self._run is not None:
            self.wanted.emit(self._run.path)


def _button(text: str, do: Callable[[], None]) -> QPushButton:
    button = QPushButton(text)
    button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    button.clicked.connect(do)
    return button


def _left() -> list[str]:
    """Paths of the runs that were left for good."""
    kept = QSettings().value(_LEFT, [])
    return [kept] if isinstance(kept, str) else list(kept or [])  # type: ignore[call-overload]  # a list of one is a text
