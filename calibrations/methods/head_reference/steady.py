"""Whether a wave comes back: what happens n times a turn, n unknown, is the same in every stretch of the arc.

Among so many orders one always follows what neighbouring settings share; only a wave that has its size in every
stretch is one of the circle.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.effects import HIGHEST_ORDER
from tumble.calibrations.methods.head_reference.table import HeadTable
from tumble.calibrations.stand_records.terms import GRADUATION
from tumble.calibrations.tracing.linear_loop import LinearExplained

_STRETCHES: Final = 8
_FEWEST_ROWS: Final = 4
"""Rows of a stretch, at least."""
_CHANCE: Final = 0.002 / HIGHEST_ORDER
"""Of a wave that is none to have so steady a size, all orders that are tried counted."""


def unsteady(explained: LinearExplained[HeadTable]) -> frozenset[str]:
    """Names of the waves of unknown order that have no steady size over the arc."""
    table, best = explained.table, explained.best
    stretch = _stretches(table.scene.angle_deg)
    if stretch is None:
        return frozenset()
    waves = [
        (item.effect.name, item.form.columns @ best.coefficients[columns])
        for item, columns in zip(best.found, best.columns, strict=True)
        if item.effect.family == GRADUATION
    ]
    return frozenset(name for name, wave in waves if _chance(wave, best.residual, stretch) > _CHANCE)


def _stretches(angle_deg: FloatArray) -> NDArray[Any] | None:
    """Number of the stretch of the arc of each row; None where there are too few rows for stretches."""
    rows = len(angle_deg)
    if rows < _STRETCHES * _FEWEST_ROWS:
        return None
    number = np.empty(rows, dtype=np.int64)
    number[np.argsort(angle_deg, kind="stable")] = np.arange(rows) * _STRETCHES // rows
    return number


def _chance(wave: FloatArray, residual: FloatArray, stretch: NDArray[Any]) -> float:
    """Chance by Student's t that sizes of a wave in the stretches, 1 on average as it was fitted, have mean 0."""
    from scipy.special import stdtr  # takes a tenth of a second, in which a window is half up

    power = np.bincount(stretch, weights=wave**2)
    size = 1.0 + np.bincount(stretch, weights=wave * residual) / np.maximum(power, 1e-300)
    deviation = float(size.std(ddof=1)) / np.sqrt(len(size))
    return 2.0 * float(stdtr(len(size) - 1, -abs(float(size.mean())) / max(deviation, 1e-12)))
