"""What a plot draws, as values: for its cursor, for the clipboard and for a file."""

import csv
import io
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import pyqtgraph as pg

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import fixed, join
from tumble.window.look.language import tr

_DIGITS: Final = 5
"""Of a value at the cursor, counted from the first one of what is in sight."""
_MOST_PLACES: Final = 9
_WITH_UNIT: Final = re.compile(r"(?P<name>.*\S)\s*\((?P<unit>[^()]+)\)")


@dataclass(frozen=True, kw_only=True)
class Series:
    """Points that belong together."""

    name: str
    """Empty where the plot has but one."""
    x: FloatArray
    y: FloatArray
    low: FloatArray | None = None
    """Lower ends of intervals; None where there are none."""
    high: FloatArray | None = None
    x_texts: Sequence[str] = ()
    """What the abscissae mean where they are no numbers for a reader, as moments."""


@dataclass(frozen=True, kw_only=True)
class Values:
    """All series of a plot, and what its axes are called."""

    bottom: str
    """With its unit in brackets: `head angle (°)`."""
    left: str
    series: tuple[Series, ...]

    def rows(self) -> Iterator[tuple[str, ...]]:
        """A line of headings, and one for each point: its series, its abscissa, its value, the ends of its interval."""
        named = any(each.name for each in self.series)
        ended = any(each.low is not None for each in self.series)
        ends = (tr("lower end"), tr("upper end")) if ended else ()
        yield (*((tr("series"),) if named else ()), self.bottom, self.left, *ends)
        for each in self.series:
            for place in range(len(each.x)):
                told = [*((each.name,) if named else ()), _x_text(each, place), _number(each.y[place])]
                yield (*told, *(_ends(each, place) if ended else ()))

    def as_csv(self) -> str:
        """A table with commas and decimal points, for another program."""
        return _table(self.rows(), ",")

    def as_text(self) -> str:
        """A table with tabs, as a spreadsheet takes it from the clipboard."""
        return _table(self.rows(), "\t")


def items_of(plot: pg.PlotItem) -> Iterator[Series]:
    """Points and lines of a plot, the points first, which were measured; other marks dress up what is there."""
    items = [item for item in plot.items if isinstance(item, pg.PlotDataItem) and item.isVisible()]
    for item in sorted(items, key=lambda item: item.opts["symbol"] is None):
        x, y = item.getOriginalDataset()
        if x is not None and len(x):
            yield Series(name=item.name() or "", x=np.asarray(x, float), y=np.asarray(y, float))


def told(name: str, value: float, in_sight: float) -> str:
    """`head angle: 12.500°`: a value under the name of its axis, to the digits that what is in sight asks for."""
    found = _WITH_UNIT.fullmatch(name)
    title, unit = (found["name"], found["unit"]) if found else (name, "")
    return f"{title}: {join(_to_digits(value, in_sight), unit)}"


def without_unit(name: str) -> str:
    """`head angle`: the name of an axis alone."""
    found = _WITH_UNIT.fullmatch(name)
    return found["name"] if found else name


def _to_digits(value: float, in_sight: float) -> str:
    places = math.ceil(_DIGITS - math.log10(in_sight)) if in_sight > 0 else _MOST_PLACES
    return fixed(value, max(places, 0)) if places <= _MOST_PLACES else f"{value:.{_DIGITS + 1}g}"


def _x_text(series: Series, place: int) -> str:
    return series.x_texts[place] if series.x_texts else _number(series.x[place])


def _ends(series: Series, place: int) -> tuple[str, str]:
    if series.low is None or series.high is None:
        return "", ""
    return _number(series.low[place]), _number(series.high[place])


def _number(value: float) -> str:
    return f"{value:.12g}" if math.isfinite(value) else ""


def _table(rows: Iterator[tuple[str, ...]], delimiter: str) -> str:
    written = io.StringIO()
    csv.writer(written, delimiter=delimiter, lineterminator="\n").writerows(rows)
    return written.getvalue()
