"""A run that came to no end, offered where the person stands."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QWidget

from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.motion_button import MotionButton

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff


class ResumeOffer(QFrame):
    """What is known of the run, and a key that goes on with it."""

    wanted = Signal(object)
    """Path of the recording."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("question")
        self._run: CutOff | None = None
        self._declined: set[Path] = set()
        self._text = PlainLabel()
        self._text.setWordWrap(True)
        self.button = MotionButton(tr("Go on with it"), "F7")
        self.button.setObjectName("primary")
        self.button.clicked.connect(self._want)
        later = QPushButton(tr("Not now"))
        later.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        later.clicked.connect(self._decline)
        layout = QHBoxLayout(self)
        layout.addWidget(self._text, stretch=1)
        layout.addWidget(self.button)
        layout.addWidget(later)

    def text(self) -> str:
        """What it says."""
        return self._text.text()

    def offer(self, runs: "Sequence[CutOff]") -> None:
        """Offer the newest of some runs, the last of them, unless it was declined; nothing where there is none."""
        wanted = [run for run in runs if run.path not in self._declined]
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

    def _want(self) -> None:
        if self._run is not None:
            self.wanted.emit(self._run.path)
