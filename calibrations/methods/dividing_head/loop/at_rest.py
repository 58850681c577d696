"""Parameters that change after the unit was seated, once they have come to rest.

A fit gives the mean over the rows of what changes along a variable without a shape. What follows the time since the
unit was seated fades: of a creep, the parameter is what is left when it has ended, and the rows do not tell whether
that, or the mean, is meant.
"""

from collections.abc import Mapping, Sequence
from typing import Final

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.tracing.courses import Course

_CHANGING: Final[Mapping[str, str]] = {"offset": "u0", "scale": "kx", "cross": "kxy", "angle": "alpha0"}
"""The parameter that a channel changes."""
_FADES: Final = "time_since_seating"


def at_rest(theta: FloatArray, courses: Sequence[Course]) -> tuple[FloatArray, ...]:
    """The parameters at the end of each course that fades; `theta` has shape (n,), the parameters first."""
    return tuple(_moved(theta, course) for course in courses if course.variable == _FADES)


def _moved(theta: FloatArray, course: Course) -> FloatArray:
    moved = theta[: len(PARAMETERS)].copy()
    moved[PARAMETERS.index(_CHANGING[course.channel])] += course.value[-1]
    return moved
