"""Records of stands with the map of a head: the one place where they are drawn."""

from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QVBoxLayout, QWidget

from calibrations.geometry import FloatArray
from window.look.plots import Plot


class StandRecords(QWidget):
    """Error of the head against its angle, with what is known of it as a band."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.plot = Plot(
            QCoreApplication.translate("StandRecords", "head angle (°)"),
            QCoreApplication.translate("StandRecords", "error of the head (″)"),
        )
        self._line = self.plot.plot([], [])
        QVBoxLayout(self).addWidget(self.plot)

    def show_head_map(self, angle_deg: FloatArray, error_arcsec: FloatArray) -> None:
        """Draw the map of a head."""
        self._line.setData(angle_deg, error_arcsec, pen=self.plot.pen(self.plot.colours.accent, 2))
