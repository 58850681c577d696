"""A parameter over time or over units."""

from collections.abc import Sequence
from datetime import datetime

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QComboBox, QFormLayout, QHBoxLayout, QVBoxLayout, QWidget

from tumble.calibrations.methods.dividing_head.model import UNITS
from tumble.calibrations.records.record import Record
from tumble.window.look.numbers import local
from tumble.window.look.plots import LocalAxis, Plot


class TrendPlot(QWidget):
    """Values with their 95% intervals, of the records found; one without a value that may be used is left out."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.parameter, self.over = QComboBox(), QComboBox()
        self.parameter.addItems(list(UNITS))
        self.parameter.setCurrentText("kx")
        self.over.addItem(self.tr("time"), "time")
        self.over.addItem(self.tr("units"), "units")
        self.plot = Plot("", "")
        self._dates, self._numbers = pg.DateAxisItem(orientation="bottom"), LocalAxis(orientation="bottom")
        self._bars = pg.ErrorBarItem(beam=0)
        self._marks = pg.ScatterPlotItem(size=9)
        self._records: Sequence[Record] = ()
        self.drawn = 0
        """How many records have a value."""
        self._lay_out()
        self.parameter.currentIndexChanged.connect(self._draw)
        self.over.currentIndexChanged.connect(self._draw)
        self.plot.recoloured.connect(self._draw)

    def show_records(self, records: Sequence[Record]) -> None:
        """Draw other records."""
        self._records = records
        self._draw()

    def _lay_out(self) -> None:
        self.plot.addItem(self._bars)
        self.plot.addItem(self._marks)
        choice = QHBoxLayout()
        for title, box in ((self.tr("P&arameter"), self.parameter), (self.tr("O&ver"), self.over)):
            form = QFormLayout()
            form.addRow(title, box)
            choice.addLayout(form)
        choice.addStretch(1)
        layout = QVBoxLayout(self)
        layout.addLayout(choice)
        layout.addWidget(self.plot, stretch=1)

    def _draw(self) -> None:
        name = self.parameter.currentText()
        told = [
            (record, parameter.value, parameter.interval_95)
            for record in self._records
            if (parameter := record.values.get(name)) and parameter.value is not None and parameter.interval_95
        ]
        self.drawn = len(told)
        x = self._places([record for record, _, _ in told])
        y = np.array([value for _, value, _ in told])
        low, high = np.array([low for *_, (low, _) in told]), np.array([high for *_, (_, high) in told])
        self._bars.setData(x=x, y=y, top=high - y, bottom=y - low, pen=self.plot.pen(self.plot.colours.pale))
        self._marks.setData(x, y, brush=self.plot.colours.accent, pen=None)
        self.plot.name_axes(self.over.currentText(), local(f"{name} ({UNITS[name].replace('^2', '²')})"))

    def _places(self, records: Sequence[Record]) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
        """Where records stand on the abscissa, which is dressed for it."""
        if self.over.currentData() == "time":
            self.plot.use_bottom_axis(self._dates)
            return np.array([_moment(record).timestamp() for record in records])
        units = list(dict.fromkeys(record.provenance.serial_number for record in records))
        self.plot.use_bottom_axis(self._numbers)
        self._numbers.setTicks([list(enumerate(units))])
        return np.array([float(units.index(record.provenance.serial_number)) for record in records])


def _moment(record: Record) -> datetime:
    measured_at = record.provenance.measured_at
    return datetime.fromisoformat(measured_at) if measured_at else record.created_at
