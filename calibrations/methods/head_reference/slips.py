"""Gross errors of a head table: dwells that differ from the repeats of their own setting.

A row is no slip for differing from its neighbours: what comes back at every visit is an error of the head. Only where
a setting was visited once is there nothing else to hold it against than the settings beside it, the weaker test.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.methods.head_reference.settings import Settings
from tumble.messages import Message

_NEIGHBOURS_FAR = 6.0
"""A dwell so many times as far from its neighbours as all but one of twenty are is a gross error."""
_ROUNDING_DEG = 1e-6
"""Scatter below this is rounding."""
_BESIDE = 3
"""So many neighbours on each side are looked at."""
_PAIR = 2


def slips(
    error_deg: FloatArray, reference_deg: FloatArray, order: NDArray[np.int64], settings: Settings
) -> dict[int, str]:
    """Dwells to be set aside, each with the reason.

    Parameters
    ----------
    error_deg
        Reference minus head, or what is left of it, shape (rows,).
    reference_deg
        What the reference says, shape (rows,): its rounding is no slip.
    order
        The dwells in an order in which neighbours err alike: by direction and angle, or of a stream by time.
    settings
        Which dwells are repeats of each other.
    """
    away_deg = _from_neighbours(error_deg, order)
    if not settings.repeated:
        return dict.fromkeys(np.flatnonzero(_far(away_deg)).tolist(), Message("gross error"))
    alone = settings.visits[settings.number] == 1
    reason: str = Message("gross error, by its neighbours")
    neighbours = dict.fromkeys(np.flatnonzero(_far(away_deg) & alone).tolist(), reason)
    return neighbours | dict(_unlike_repeats(error_deg, away_deg, _rounding_deg(reference_deg), settings))


def _from_neighbours(error_deg: FloatArray, order: NDArray[np.int64]) -> FloatArray:
    """How far each dwell lies from the median of those beside it, itself among them, shape (rows,)."""
    values = error_deg[order]
    beside = [np.median(values[max(0, row - _BESIDE) : row + _BESIDE + 1]) for row in range(len(values))]
    away_deg = np.empty(len(values))
    away_deg[order] = np.abs(values - np.array(beside))
    return away_deg


def _far(away_deg: FloatArray) -> NDArray[np.bool_]:
    limit_deg = _NEIGHBOURS_FAR * max(float(np.quantile(away_deg, 0.95)), _ROUNDING_DEG)
    return np.asarray(away_deg > limit_deg)


def _unlike_repeats(
    error_deg: FloatArray, away_deg: FloatArray, rounding_deg: float, settings: Settings
) -> Iterator[tuple[int, str]]:
    """Dwells far from the median of the other visits to their setting; of two, the one that is off its neighbours."""
    others_deg = _median_of_others(error_deg, settings)
    repeated = settings.visits[settings.number] > 1
    apart_deg = np.where(repeated, error_deg - others_deg, 0.0)
    scale_deg = max(1.4826 * float(np.median(np.abs(apart_deg[repeated]))), rounding_deg / 2)
    limit_deg = gross_sigmas(len(error_deg) - len(settings.visits)) * scale_deg
    for row in np.flatnonzero(np.abs(apart_deg) > limit_deg).tolist():
        others = settings.others(row)
        if len(others) + 1 == _PAIR and away_deg[others[0]] > away_deg[row]:
            continue
        yield row, _apart(float(apart_deg[row]))


def _apart(apart_deg: float) -> Message:
    if apart_deg > 0:
        return Message("gross error: {apart_deg:.3g}° more than the repeats of its setting", apart_deg=apart_deg)
    return Message("gross error: {apart_deg:.3g}° less than the repeats of its setting", apart_deg=-apart_deg)


def _median_of_others(values: FloatArray, settings: Settings) -> FloatArray:
    """Median of the other visits to the setting of each dwell, shape (rows,); its own value where there are none."""
    middle = values.copy()
    order = np.lexsort((values, settings.number))
    for rows in np.split(order, np.cumsum(settings.visits)[:-1]):
        if len(rows) > 1:
            place, left = np.arange(len(rows)), len(rows) - 1
            ranks = [rank + (rank >= place) for rank in ((left - 1) // 2, left // 2)]
            middle[rows] = (values[rows[ranks[0]]] + values[rows[ranks[1]]]) / 2.0
    return middle


def _rounding_deg(reference_deg: FloatArray) -> float:
    """The smallest step between two readings of the reference: what it is rounded to, if it is."""
    steps_deg = np.diff(np.unique(np.round(reference_deg, 9)))
    return float(steps_deg.min()) if len(steps_deg) else _ROUNDING_DEG
