"""The bar that is always there: STOP, where the run stands, where the head is."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QWidget

from drivers.manual import format_dms
from drivers.protocols import HeadStatus
from window.look.numbers import local


class StopBar(QWidget):
    """STOP is never disabled and takes no focus; Esc presses it too."""

    stop_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.state, self._angle, self._busy = QLabel(), QLabel(), QLabel()
        self.button = QPushButton(self.tr("⬢ STOP  [Esc]"))
        self.button.setObjectName("stop")
        self.button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.button.setAccessibleName(self.tr("Stop the head"))
        self.button.clicked.connect(self.stop_wanted)
        self._angle.setMinimumWidth(self._angle.fontMetrics().horizontalAdvance("↻ -000° 00′ 00.0″"))
        for label in (self.state, self.button):
            font = label.font()
            font.setBold(True)
            font.setPointSizeF(font.pointSizeF() * 1.3)
            label.setFont(font)
        self._busy.setObjectName("pale")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 6)
        for part, stretch in ((self.state, 2), (self._busy, 1), (self._angle, 0), (self.button, 0)):
            layout.addWidget(part, stretch)
        self.show_head(None)

    def show_head(self, status: HeadStatus | None) -> None:
        """Show where the head is; None where nobody knows."""
        if status is None:
            self._angle.setText(self.tr("not connected"))
        else:
            self._angle.setText(f"{'↻ ' if status.moving else ''}{local(format_dms(status.angle_deg))}")

    def show_busy(self, busy: bool) -> None:
        """Say whether an analysis is under way."""
        self._busy.setText(self.tr("computing…") if busy else "")
