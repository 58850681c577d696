"""alpha0 where a named error of the head stands beside an error of the angle that has no name.

A shape without a name is nought in its mean, an eccentricity too; a play is nought after moves in one direction. If the
named error is a part of the other one, what both are of is nought somewhere else, and no row tells where: alpha0 may be
what it is at any place of the two together.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.loop.augmented import Augmented
from tumble.calibrations.methods.dividing_head.model import ALPHA0, PARAMETERS
from tumble.calibrations.tracing.averaged import Reach
from tumble.calibrations.tracing.courses import Course
from tumble.messages import Message

_OF_THE_HEAD: Final = frozenset({"angle", "direction"})
"""What errors of the head depend on."""
_STEEP: Final = 0.5
"""Of the steepest row's slope: rows that are less steep show less of an error of the angle."""


def alpha0_reach(best: Augmented, courses: Sequence[Course]) -> Mapping[str, Reach]:
    """How far alpha0, in degrees, may be from what is stated; empty where not both kinds of error were found."""
    nameless = [course.value for course in courses if course.channel == "angle"]
    named = list(_named_errors_deg(best))
    if not nameless or not named:
        return {}
    errors_deg = (*nameless, *named)
    below, above = (sum(float(end(each)) for each in errors_deg) for end in (np.min, np.max))
    return {PARAMETERS[ALPHA0]: Reach(below=min(below, 0.0), above=max(above, 0.0))}


def remarked(parameters: Mapping[str, Parameter], reaches: Mapping[str, Reach]) -> dict[str, Parameter]:
    """The same parameters; one with a reach says why."""
    remark = Message(
        "the named error of the head may be a part of the one without a name; the interval holds wherever both "
        "together are nought"
    )
    return {
        name: replace(each, remark=remark) if name in reaches and each.value is not None and not each.remark else each
        for name, each in parameters.items()
    }


def _named_errors_deg(best: Augmented) -> Iterator[FloatArray]:
    """Each named error of the head in the rows that show it, shape (rows,)."""
    slope_v_per_deg = best.joint.scene.slope_v_per_deg
    steep = np.abs(slope_v_per_deg) >= _STEEP * np.abs(slope_v_per_deg).max()
    for item, columns in zip(best.found, best.columns, strict=True):
        if item.effect.belongs_to == "stand" and item.effect.depends_on in _OF_THE_HEAD:
            error_v = item.form.columns @ best.coefficients[columns]
            yield np.asarray(error_v[steep] / slope_v_per_deg[steep])
