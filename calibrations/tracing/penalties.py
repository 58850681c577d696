"""Every penalty of the tracing, in -2 ln L, in one list: what each stands for, and from what it follows.

A penalty is the fall that meaningless columns, or a meaningless variance, reach with a chance; what is tried shares
that chance. Where two explanations are compared that are both there, it is odds: 6 are odds of 20 to 1.
"""

from functools import cache
from typing import Final

import numpy as np
from scipy.special import chdtri, fdtri

FALSE_ALARM: Final = 0.001
"""Chance that a clean table is given any named effect at all; as much again for structure without a name. Effects share
it evenly, the forms of an effect its share."""
ANOTHER_SHAPE: Final = 0.02
"""Chance that an effect with one of the shapes of the catalogue is given a second one."""
NOT_FOUND: Final = 0.02
"""Chance that a table holds an effect that is not found: parameters are averaged over what is so likely."""

UNNAMED: Final = 3.84
"""By so much a component must explain more than the best set of names (chi-square, one degree of freedom, 95%): a known
cause is the better guess. By so much must a name beside a component along its variable, of which it may be a part."""
SHAPE_UNNAMED: Final = 6.0
"""Of a given shape without a name beyond that of a named one, for the same reason: odds of 20 to 1."""
FOLLOWS_ANYTHING: Final = 5.0
"""Of a course of the bias in time beside what follows another variable, odds of 12 to 1: in a run that is slow, it
follows most of what that does."""

FLICKER: Final = 4.0
"""One variance at a chance of 0.023: the ordinary noise of a unit, which is expected."""
WALKS: Final = 0.0005
"""Chance that a clean table is given a random walk: half of `FALSE_ALARM`."""
WALK: Final = 11.0
"""One variance at that chance. It parts a walk from flicker with a floor of a fifth of a
dwell's deviation: in one of a hundred tables flicker still earns it, and of walks of 12 noise units three in ten do
not. `python -m benchmarks.loop clean` and `exactness` must be run again when it is changed."""
LEVEL: Final = 13.0
"""Of random effects: one variance at a chance of 0.00016, a sixth of `FALSE_ALARM`."""

SIMPLER: Final = 6.0
"""Of each coefficient in the choice of the name, odds of 20 to 1: of two effects the simpler may be a special case."""
WALK_NAMED: Final = 9.0
"""Of a random walk in the choice of the name, beyond its own: the better fit decides, by three standard deviations."""
CLOSE: Final = 3.84
"""Two explanations whose deviances differ by less are not distinguishable (chi-square, one degree of freedom, 95%)."""
NEAR: Final = 9.0
"""Nor must what is said of a parameter hang on which of two explanations that differ by less is true: by mere chance
the wrong one of two that explain a table much alike is ahead by more than `CLOSE` in one of forty."""


def of_columns(width: int, chance: float, rows: int, spare: int) -> float:
    """Fall of the deviance that an F test of columns asks for; of the rows, `spare` are more than is fitted."""
    freedom = max(spare - width, 1)
    return float(rows * np.log1p(width * fdtri(width, freedom, 1.0 - chance) / freedom))


@cache
def of_variance(chance: float) -> float:
    """Fall of -2 ln L that a variance without meaning reaches with this chance.

    A variance is at its bound where there is nothing: half the chance of chi-square with one degree of freedom (Self
    and Liang 1987).
    """
    return float(chdtri(1, min(2.0 * chance, 1.0)))
