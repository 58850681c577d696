"""Turning a positioner by hand on the keyboard: by a step, to an angle, to its reference."""

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QEvent, QSettings, Signal
from PySide6.QtWidgets import QComboBox, QFrame, QGridLayout, QLabel, QLineEdit, QWidget

from tumble.drivers.manual import parse_reading
from tumble.window.kept import kept_place
from tumble.window.look.language import tr
from tumble.window.look.names import instrument_name
from tumble.window.look.numbers import local
from tumble.window.widgets.motion_button import MotionButton

_STEPS_DEG: Final = ("0.01", "0.1", "1", "5", "10", "45", "90")


class Jog(QFrame):
    """Every motion by a key that no scanner types; Enter in the field of the angle moves nothing."""

    step_wanted = Signal(str, float)
    """Which positioner, and by how many degrees."""
    angle_wanted = Signal(str, float)
    home_wanted = Signal(str)
    misunderstood = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("card")
        self.positioner, self.step, self.angle = QComboBox(), QComboBox(), QLineEdit()
        for step in _STEPS_DEG:
            self.step.addItem(local(f"{step}°"), float(step))
        self.step.setCurrentIndex(kept_place("stand/step", 4, len(_STEPS_DEG)))
        self.positioner.setAccessibleName(tr("Positioner"))
        self.angle.setPlaceholderText(tr("12 34 56, or 12.5"))
        self.back = MotionButton("◀", "Ctrl+Left")
        self.ahead = MotionButton("▶", "Ctrl+Right")
        self.go = MotionButton(tr("Go"), "F8")
        self.home = MotionButton(tr("Home"), "Ctrl+Home")
        self.back.setAccessibleName(tr("One step back"))
        self.ahead.setAccessibleName(tr("One step ahead"))
        self._lay_out()
        self.back.clicked.connect(lambda: self.step_wanted.emit(self._name, -self._step_deg))
        self.ahead.clicked.connect(lambda: self.step_wanted.emit(self._name, self._step_deg))
        self.go.clicked.connect(self._go)
        self.home.clicked.connect(lambda: self.home_wanted.emit(self._name))
        self.step.currentIndexChanged.connect(lambda index: QSettings().setValue("stand/step", index))

    def show_positioners(self, names: Sequence[str]) -> None:
        """Have the choice of several positioners; of one there is none."""
        self.positioner.clear()
        for name in names:
            self.positioner.addItem(instrument_name(name), name)
        self.positioner.setVisible(len(names) > 1)

    @property
    def _name(self) -> str:
        return str(self.positioner.currentData())

    @property
    def _step_deg(self) -> float:
        return float(self.step.currentData())

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        step, angle = QLabel(tr("S&tep")), QLabel(tr("&Angle"))
        step.setBuddy(self.step)
        angle.setBuddy(self.angle)
        for row, parts in enumerate(
            ((step, self.step, self.back, self.ahead), (angle, self.angle, self.go, self.home))
        ):
            for column, part in enumerate(parts):
                grid.addWidget(part, row, column)
        grid.addWidget(self.positioner, 2, 0, 1, 4)
        grid.setColumnStretch(1, 1)
        self._keep_readable()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Grow with the text."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._keep_readable()

    def _keep_readable(self) -> None:
        """Have room for an example of an angle, with what is around it."""
        example = f"{self.angle.placeholderText()}MM"
        self.angle.setMinimumWidth(self.fontMetrics().horizontalAdvance(example))

    def _go(self) -> None:
        try:
            self.angle_wanted.emit(self._name, parse_reading(self.angle.text()))
        except ValueError as error:
            self.misunderstood.emit(f"{error}.")
