"""Gross errors: how far from all others a value must lie to be one."""

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
