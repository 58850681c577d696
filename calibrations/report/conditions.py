"""Under what conditions a unit was measured (ISO/IEC 17025:2017, 7.8.4.1 b), as far as the rows tell."""

from typing import Final

import numpy as np

from tumble.calibrations.core.rows import Rows

_TEMPERATURE: Final = ("temperature", "_degc")
"""How the name of a column of temperatures begins and ends."""


def temperatures_degc(rows: Rows) -> tuple[float, float] | None:
    """The lowest and the highest temperature at sensor or unit, in °C; None where the rows hold none."""
    begin, end = _TEMPERATURE
    columns = (getattr(rows, name) for name in rows.columns() if name.startswith(begin) and name.endswith(end))
    known = [column[np.isfinite(column)] for column in columns if column is not None]
    found = np.concatenate(known) if known else np.empty(0)
    return (float(found.min()), float(found.max())) if len(found) else None
