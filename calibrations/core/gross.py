"""Gross errors: how far from all others a value must lie to be one, and how far where its neighbours are."""

from itertools import pairwise

import numpy as np

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


def burst(gross: BoolArray, doubtful: BoolArray, time_s: FloatArray | None) -> BoolArray:
    """Rows of bursts: gross errors, what is doubtful near them, and what lies between these, shape (rows,).

    A disturbance that lasts lifts the scatter of rows that follow each other; by chance a part of them lies near the
    others all the same. `doubtful` are rows half as far off as a gross error, alone no reason to set them aside.
    """
    order = np.arange(len(gross)) if time_s is None else np.argsort(time_s, kind="stable")
    in_order, doubt = gross[order], (gross | doubtful)[order]
    while True:
        near = _reached(in_order)
        grown = in_order | (near & doubt)
        if np.array_equal(grown, in_order):
            break
        in_order = grown
    members = np.flatnonzero(in_order)
    for first, last in pairwise(members):
        in_order[first:last] |= last - first <= NEIGHBOURS + 1
    rows = np.zeros(len(gross), dtype=bool)
    rows[order] = in_order
    return rows


def _reached(members: BoolArray) -> BoolArray:
    """Rows at most `NEIGHBOURS` away from a member."""
    return np.convolve(members, np.ones(2 * NEIGHBOURS + 1), mode="same") > 0.5
