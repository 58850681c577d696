"""Gross errors: how far from all others a value must lie to be one, and how far where its neighbours are."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import BoolArray, FloatArray

GROSS_SIGMA = 6.0
"""A row this many robust standard deviations off is a gross error; among 10,000 good rows none is expected."""


_CHANCE = 1e-5
"""Chance at which a good row of a short table may be that far off; there the scale itself is uncertain."""


_EFFICIENCY = 0.37
"""Of the median absolute deviation (Huber and Ronchetti, Robust Statistics, 5.1): so many of the spare rows count."""


def gross_sigmas(spare_rows: int) -> float:
    """How many robust standard deviations make a gross error: more where few rows are to spare."""
    from scipy.special import stdtrit  # takes a tenth of a second, in which a window is half up

    student = float(stdtrit(max(_EFFICIENCY * spare_rows, 1.0), 1.0 - _CHANCE / 2))
    return max(GROSS_SIGMA, student)


NEIGHBOURS = 2
"""Rows after a gross error, and before it, in which a burst of disturbance may go on."""
_FEWEST = 3
"""Rows of a burst; of fewer only the gross errors are set aside, for one good row in 300 is doubtful by chance."""


def burst(gross: BoolArray, doubtful: BoolArray, time_s: FloatArray | None) -> BoolArray:
    """Rows of bursts: gross errors, what is doubtful near them, and what lies between these, shape (rows,).

    A disturbance that lasts lifts the scatter of rows that follow each other; by chance a part of them lies near the
    others all the same. `doubtful` are rows half as far off as a gross error, alone no reason to set them aside.
    """
    order = np.arange(len(gross)) if time_s is None else np.argsort(time_s, kind="stable")
    rows = gross.copy()
    for members in _chains(_grown(gross[order], (gross | doubtful)[order])):
        if len(members) >= _FEWEST:
            rows[order[members[0] : members[-1] + 1]] = True
    return rows


def _grown(members: BoolArray, doubtful: BoolArray) -> BoolArray:
    """Gross errors with all that is doubtful near them, near those, and so on."""
    while not np.array_equal(grown := members | (_reached(members) & doubtful), members):
        members = grown
    return members


def _reached(members: BoolArray) -> BoolArray:
    """Rows at most `NEIGHBOURS` away from a member."""
    near = members.copy()
    for away in range(1, NEIGHBOURS + 1):
        near[away:] |= members[:-away]
        near[:-away] |= members[away:]
    return near


def _chains(members: BoolArray) -> list[NDArray[np.int64]]:
    """Places of members, parted where more rows lie between two than a burst goes on over."""
    places = np.flatnonzero(members)
    return np.split(places, np.flatnonzero(np.diff(places) > NEIGHBOURS) + 1)
