"""The bar that is always there: STOP, where the run stands, where every positioner is."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSizePolicy, QWidget

from tumble.drivers.manual import format_dms
from tumble.drivers.protocols import PositionerStatus
from tumble.window.look.language import tr
from tumble.window.look.numbers import local
from tumble.window.stop_guard import STOP_KEYS


class StopBar(QWidget):
    """STOP is never disabled, takes no focus, and keeps its size: the words beside it make room."""

    stop_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.state, self._angle, self._busy = QLabel(), QLabel(), QLabel()
        self.button = QPushButton(tr("⬢ STOP") + f"  [{STOP_KEYS[0]}]")
        self.button.setObjectName("stop")
        self.button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.button.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.button.setAccessibleName(tr("Stop the head"))
        self.button.clicked.connect(self.stop_wanted)
        self.state.setObjectName("state")
        self._busy.setObjectName("pale")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 6)
        for label, stretch in ((self.state, 3), (self._busy, 1), (self._angle, 1)):
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
            label.setWordWrap(True)
            layout.addWidget(label, stretch)
        self._angle.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        layout.addWidget(self.button)
        self._statuses: dict[str, PositionerStatus] = {}
        self.forget_positions()

    def show_state(self, text: str, fault: bool) -> None:
        """Say where the run stands, in red where that is a fault."""
        self.state.setObjectName("fault" if fault else "state")
        self.state.style().polish(self.state)
        self.state.setText(text)

    def forget_positions(self) -> None:
        """Nobody knows where anything is."""
        self._statuses = {}
        self._angle.setText(tr("not connected"))

    def show_position(self, name: str, status: PositionerStatus) -> None:
        """Show where a positioner is; several go by their names."""
        self._statuses[name] = status
        angles = {each: _angle(known) for each, known in self._statuses.items()}
        named = (f"{each} {angle}" for each, angle in angles.items())
        self._angle.setText("\n".join(named if len(angles) > 1 else angles.values()))

    def show_busy(self, busy: bool) -> None:
        """Say whether an analysis is under way."""
        self._busy.setText(tr("computing…") if busy else "")


def _angle(status: PositionerStatus) -> str:
    if not status.referenced:
        return tr("angle not known")
    return f"{'↻ ' if status.turning else ''}{local(format_dms(status.angle_deg))}"
