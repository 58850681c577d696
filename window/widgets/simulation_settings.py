"""How a stand that exists in this process only lives: who seats the unit there, and how fast time goes."""

from functools import partial
from typing import Final

from PySide6.QtCore import QSettings, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QFrame, QHBoxLayout, QLabel, QWidget

from tumble.app.wiring import Attendant, obliging_operator
from tumble.procedures.operator import Operator
from tumble.window.kept import kept_place, kept_text
from tumble.window.look.language import tr

_SPEEDS: Final = (None, 1.0, 10.0, 100.0)
"""Times real time; None takes no time at all."""


class SimulationSettings(QFrame):
    """A person or nobody, and times real time; remembered."""

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self.imagined = QCheckBox(tr("The simulated operator seats the unit"))
        self.speed = QComboBox()
        for factor in _SPEEDS:
            self.speed.addItem(tr("at once") if factor is None else f"× {factor:g}", factor)
        self.imagined.setChecked(kept_text("simulation/imagined") == "true")
        self.speed.setCurrentIndex(kept_place("simulation/speed", 2, len(_SPEEDS)))
        layout = QHBoxLayout(self)
        label = QLabel(tr("Simulated stand: time"))
        label.setWordWrap(True)
        layout.addWidget(label)
        layout.addWidget(self.speed)
        layout.addWidget(self.imagined, stretch=1)
        self.imagined.toggled.connect(self._remember)
        self.speed.currentIndexChanged.connect(self._remember)

    def attendant(self, person: Operator) -> Attendant:
        """Who is asked on a simulated stand."""
        operator = obliging_operator if self.imagined.isChecked() else partial(_the, person)
        return Attendant(operator=operator, speed=self.speed.currentData())

    def _remember(self) -> None:
        QSettings().setValue("simulation/imagined", "true" if self.imagined.isChecked() else "false")
        QSettings().setValue("simulation/speed", self.speed.currentIndex())
        self.changed.emit()


def _the(person: Operator) -> Operator:
    return person
