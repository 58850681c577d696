"""When the rows of a table of runs were taken, by whatever column says it."""

import re
from collections.abc import Mapping
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.temperature.columns import Column, column_of

_SECONDS: Final = {
    **dict.fromkeys(("s", "seconds"), 1.0),
    "ms": 1e-3,
    "us": 1e-6,
    **dict.fromkeys(("min", "minutes"), 60.0),
    **dict.fromkeys(("h", "hours"), 3600.0),
    "days": 86_400.0,
}
"""Seconds in the unit in which the name of a column of times ends."""
_CLOCK: Final = re.compile(r"(^|_)(t|time|date|timestamp|datetime|clock|elapsed)(_|$)", re.IGNORECASE)
"""Words for a moment; other columns of times (`settling_s`) may be how long something took."""


def clock_s(columns: Mapping[str, FloatArray]) -> FloatArray | None:
    """Moments of the rows in seconds, from the first column that says when and in which unit; None without one.

    A column of times that is not called one is a clock where it rises from row to row.
    """
    for name, values in columns.items():
        second = _SECONDS.get(name.rsplit("_", 1)[-1].lower())
        if second and column_of(name) is Column.TIME and (_CLOCK.search(name) or bool(np.all(np.diff(values) > 0))):
            return values * second
    return None
