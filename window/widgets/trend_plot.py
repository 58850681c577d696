"""A parameter over time, units, lots or stands."""

from collections.abc import Iterator, Sequence
from datetime import datetime
from html import escape
from typing import Final

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QFormLayout, QHBoxLayout, QVBoxLayout, QWidget

from tumble.app.headline import headline
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_limits
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.window.look.date_axis import DateAxis
from tumble.window.look.language import tr
from tumble.window.look.moments import day_text
from tumble.window.look.names import short_name
from tumble.window.look.numbers import local
from tumble.window.look.plots import LocalAxis, Plot
from tumble.window.look.sentences import in_language
from tumble.window.plots.values import Series
from tumble.window.widgets.series_plot import SIGNS

_LEAST_S: Final = 3600.0
"""What is shown of time, at least: the axis of one moment would be fractions of a second."""


class TrendPlot(QWidget):
    """Values with their 95% intervals, of the records found; one without a value that may be used is left out.

    The limits are those of the newest of them; where they are out of sight, their numbers stand above.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.parameter, self.over = QComboBox(), QComboBox()
        self.parameter.addItem("—")
        self.over.addItem(tr("time"), "time")
        self.over.addItem(tr("units"), "units")
        self.over.addItem(tr("lots"), "lots")
        self.over.addItem(tr("stands"), "stands")
        self.plot = Plot("", "")
        self._dates, self._numbers = DateAxis(orientation="bottom"), LocalAxis(orientation="bottom")
        self._bars = pg.ErrorBarItem(beam=0)
        self._marks = pg.ScatterPlotItem()
        self._limits = [pg.InfiniteLine(angle=0, movable=False) for _ in ("low", "high")]
        self.records: Sequence[Record] = ()
        """Those that are drawn, as far as they have a value."""
        self.drawn = 0
        """How many records have a value."""
        self.key = ""
        """What the colours and shapes mean, as markup."""
        self._lay_out()
        for choice in (self.parameter, self.over):
            choice.currentIndexChanged.connect(self._draw)
            choice.currentIndexChanged.connect(self.plot.way_back.home)
        self.plot.recoloured.connect(self._draw)

    def show_records(self, records: Sequence[Record]) -> None:
        """Draw other records, of the parameter that is chosen where one of them has it."""
        self.records = records
        self._offer()
        self._draw()

    def _offer(self) -> None:
        """Offer the parameters of all records; one whose unit differs between methods once for each."""
        offered = list(dict.fromkeys(_key(each) for record in self.records for each in record.values.values()))
        chosen = self.parameter.currentData() or self._headline()
        self.parameter.blockSignals(True)
        self.parameter.clear()
        for name, unit in offered:
            self.parameter.addItem(name, (name, unit))
        if not offered:
            self.parameter.addItem("—")
        self.parameter.setCurrentIndex(offered.index(chosen) if chosen in offered else 0)
        self.parameter.blockSignals(False)

    def _headline(self) -> tuple[str, str] | None:
        """That which stands for the result of the newest record."""
        found = (headline(record) for record in self.records)
        return next((_key(each) for each in found if each is not None), None)

    def _lay_out(self) -> None:
        self.plot.addItem(self._bars)
        self.plot.addItem(self._marks)
        for line in self._limits:
            self.plot.addItem(line, ignoreBounds=True)
        choice = QHBoxLayout()
        for title, box in ((tr("Parame&ter"), self.parameter), (tr("Ove&r"), self.over)):
            form = QFormLayout()
            form.addRow(title, box)
            choice.addLayout(form)
        choice.addStretch(1)
        layout = QVBoxLayout(self)
        layout.addLayout(choice)
        layout.addWidget(self.plot, stretch=1)

    def _draw(self) -> None:
        name, unit = self.parameter.currentData() or ("", "")
        told = [
            (record, parameter.value, parameter.interval_95)
            for record in self.records
            if (parameter := record.values.get(name))
            and parameter.unit == unit
            and parameter.value is not None
            and parameter.interval_95
        ]
        self.drawn = len(told)
        x = self._places([record for record, _, _ in told])
        y = np.array([value for _, value, _ in told])
        low, high = np.array([low for *_, (low, _) in told]), np.array([high for *_, (_, high) in told])
        self._bars.setData(x=x, y=y, top=high - y, bottom=y - low, pen=self.plot.pen(self.plot.colours.pale))
        units = [record.provenance.serial_number for record, *_ in told]
        self._mark(units, x, y)
        self._draw_limits([record for record, *_ in told], name, unit)
        places = [self._place(record) for record, *_ in told]
        self.plot.state(_series(units, places, x, y, low, high))
        self.plot.name_axes(
            self._abscissa([record for record, *_ in told]),
            local(f"{name} ({unit.replace('^2', '²')})" if name else ""),
        )
        self.plot.entitle(self.key)

    def _mark(self, units: Sequence[str], x: FloatArray, y: FloatArray) -> None:
        """Draw every unit in a colour and shape of its own; those that there are no more of look alike."""
        shades, distinct = self.plot.colours.data, list(dict.fromkeys(units))
        styles = dict(zip(distinct, zip(shades, SIGNS, strict=False), strict=False))
        other = (self.plot.colours.pale, "o")
        drawn = [styles.get(unit, other) for unit in units]
        self._marks.setSize(self.plot.mark_px)
        self._marks.setData(x, y, brush=[shade for shade, _ in drawn], symbol=[shape for _, shape in drawn], pen=None)
        told = [(shade, SIGNS[shape], unit) for unit, (shade, shape) in styles.items()]
        rest = [tr("and {count} more", count=len(distinct) - len(styles))] if len(distinct) > len(styles) else []
        marks = [f'<span style="color: {shade}">{sign}</span> {escape(short_name(unit))}' for shade, sign, unit in told]
        self.key = "".join(f" &nbsp; {mark}" for mark in (*marks, *rest))

    def _draw_limits(self, records: Sequence[Record], name: str, unit: str) -> None:
        """Draw the limits of a parameter, where the newest record has some, and say them in the key."""
        newest = max(records, key=_moment, default=None)
        check = next((each for each in newest.limits if each.name == name), None) if newest else None
        pen = self.plot.pen(self.plot.colours.bad, style=Qt.PenStyle.DashLine)
        for line, end in zip(self._limits, (check.minimum, check.maximum) if check else (None, None), strict=True):
            line.setVisible(end is not None)
            line.setPen(pen)
            line.setValue(0.0 if end is None else end)
        if check is not None:
            said = tr("limits {limits}", limits=in_language(format_limits(check.minimum, check.maximum, unit)))
            self.key += f' &nbsp; <span style="color: {self.plot.colours.bad}">– –</span> {escape(said)}'

    def _place(self, record: Record) -> str:
        """Where a record stands, in words."""
        if self.over.currentData() == "time":
            return _moment(record).astimezone().isoformat(" ", "seconds")
        origin = record.provenance
        named = {"units": origin.serial_number, "lots": origin.lot, "stands": origin.stand_name}
        return named[self.over.currentData()] or "—"

    def _abscissa(self, records: Sequence[Record]) -> str:
        """What is drawn to the right; the ticks of a short time are hours, which say no day."""
        if self.over.currentData() != "time" or not records:
            return self.over.currentText()
        moments = [_moment(record).astimezone() for record in records]
        days = dict.fromkeys(map(day_text, (min(moments), max(moments))))
        return f"{self.over.currentText()}, {' – '.join(days)}"

    def _places(self, records: Sequence[Record]) -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
        """Where records stand on the abscissa, which is dressed for it; without any it tells no time."""
        if records and self.over.currentData() == "time":
            self.plot.use_bottom_axis(self._dates)
            self.plot.getViewBox().setLimits(minXRange=_LEAST_S)
            return np.array([_moment(record).timestamp() for record in records])
        places = list(dict.fromkeys(map(self._place, records)))
        self.plot.use_bottom_axis(self._numbers)
        self.plot.getViewBox().setLimits(minXRange=None)
        self._numbers.setTicks([list(enumerate(map(short_name, places)))])
        return np.array([float(places.index(self._place(record))) for record in records])


def _series(
    units: Sequence[str], x_texts: Sequence[str], x: FloatArray, y: FloatArray, low: FloatArray, high: FloatArray
) -> Iterator[Series]:
    """The values of every unit, with their intervals."""
    for unit in dict.fromkeys(units):
        of = np.array([each == unit for each in units])
        texts = [text for text, each in zip(x_texts, units, strict=True) if each == unit]
        yield Series(name=unit, x=x[of], y=y[of], low=low[of], high=high[of], x_texts=texts)


def _key(parameter: RecordedParameter) -> tuple[str, str]:
    return parameter.name, parameter.unit


def _moment(record: Record) -> datetime:
    measured_at = record.provenance.measured_at
    return datetime.fromisoformat(measured_at) if measured_at else record.created_at
