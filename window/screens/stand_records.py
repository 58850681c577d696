"""Records of stands with the map of a head: the one place where they are drawn."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pyqtgraph as pg
from PySide6.QtWidgets import QComboBox, QVBoxLayout, QWidget

from tumble.window.look.language import tr
from tumble.window.look.plots import Plot

if TYPE_CHECKING:  # the analysis takes half a second: a window is up before that
    from tumble.calibrations.stand_records.record import StandRecord

_ARCSEC = 3600.0


class StandRecords(QWidget):
    """What is known of each stand; error of its head against the angle, with two standard uncertainties as a band."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.choice = QComboBox()
        self.plot = Plot(
            tr("head angle (°)"),
            tr("error of the head (″)"),
        )
        self.line = self.plot.plot([], [], name=tr("error of the head (″)"))
        self._low = self.plot.plot([], [], name=tr("error less two standard uncertainties"))
        self._high = self.plot.plot([], [], name=tr("error plus two standard uncertainties"))
        self._band = pg.FillBetweenItem(self._low, self._high)
        self.plot.addItem(self._band)
        self._records: tuple[StandRecord, ...] = ()
        layout = QVBoxLayout(self)
        layout.addWidget(self.choice)
        layout.addWidget(self.plot)
        self.choice.currentIndexChanged.connect(self._draw)
        self.plot.recoloured.connect(self._recolour)
        self._recolour()

    def show_records(self, records: "Sequence[StandRecord]") -> None:
        """List the records of all stands, the newest first, and draw that."""
        self._records = tuple(sorted(records, key=lambda record: record.created_at, reverse=True))
        self.choice.clear()
        self.choice.addItems([f"{each.identity.stand} {each.version}, {each.status}" for each in self._records])

    def _recolour(self) -> None:
        self.line.setPen(self.plot.pen(self.plot.colours.accent, 2))
        for edge in (self._low, self._high):
            edge.setPen(self.plot.pen(self.plot.colours.pale, 1))
        self._band.setBrush(self.plot.band)

    def _draw(self, place: int) -> None:
        from tumble.app.stand_records import head_map_curve

        curve = head_map_curve(self._records[place]) if 0 <= place < len(self._records) else None
        if curve is None:
            for line in (self.line, self._low, self._high):
                line.setData([], [])
            return
        error, twice = curve.error_deg * _ARCSEC, 2 * curve.standard_uncertainty_deg * _ARCSEC
        self.line.setData(curve.angle_deg, error)
        self._low.setData(curve.angle_deg, error - twice)
        self._high.setData(curve.angle_deg, error + twice)
