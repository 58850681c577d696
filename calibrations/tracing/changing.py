"""Parameters that structure without a name changes: what they are at each place of the variable that it follows.

A channel may be what a parameter stands for in some of the rows: an offset of the output in all of them is a bias. Then
a course of it has no level of its own, and no row tells whether the parameter is the mean of the course or what it is
at one of its places. A wave of whole periods has a mean, and a bump a level where rows lie on both sides of it; what
has steps leaves each level open by its own columns.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.courses import Course, Rows, courses
from tumble.calibrations.tracing.shapes.bells import BUMP

_PART_OF: Final = 1e-6
"""A channel that parameters follow but for so small a part of it is theirs."""
_WHOLE_PERIODS: Final = 1.0
"""Of a wave."""
_STILL_THERE: Final = 0.5
"""A bump of which so much is left at the first place, or at the last, has no level beyond it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Changing:
    """What one component changes."""

    component: Component
    course: Course
    changes: FloatArray
    """Of the parameters at each place of the course, shape (places, parameters)."""


def changing(rows: Rows, slopes: FloatArray, components: Sequence[Component]) -> Iterator[Changing]:
    """Every component that changes parameters and has no level of its own.

    `slopes` are the derivatives of the rows with the parameters, shape (rows, parameters).
    """
    for component, course in zip(components, courses(rows, components), strict=True):
        share = _share(component, slopes)
        if share.any() and not _has_level(component, course.value):
            yield Changing(component=component, course=course, changes=np.outer(course.value, share))


def _share(component: Component, slopes: FloatArray) -> FloatArray:
    """By how much parameters change for a unit of the channel of a component, shape (parameters,); 0 if they do not."""
    gain = component.axis.channel.gain
    acts = gain != 0.0
    length = np.linalg.norm(slopes[acts], axis=0)
    scaled = slopes[acts] / np.where(length > 0.0, length, 1.0)
    share = np.linalg.lstsq(scaled, gain[acts], rcond=_PART_OF)[0]
    left = float(np.linalg.norm(gain[acts] - scaled @ share))
    if left > _PART_OF * float(np.linalg.norm(gain)):
        return np.zeros(slopes.shape[1])
    return np.asarray(share / np.where(length > 0.0, length, 1.0))


def _has_level(component: Component, value: FloatArray) -> bool:
    """Whether what a component does, `value` at its places in their order, says what the channel is without it."""
    word, *sizes = component.shape.split()
    if word == "wave":
        return float(sizes[0]) >= _WHOLE_PERIODS
    if word == BUMP and component.axis.coordinate.period is None:
        return bool(np.abs(value[[0, -1]]).max() < _STILL_THERE * np.abs(value).max())
    return not (component.is_course or word == "bend")
