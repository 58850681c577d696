"""Where a run contradicts an adopted effect: it is not there, it is of another size, or it has another course."""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np
from scipy.special import ndtr

from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.adopted.left import left
from tumble.calibrations.adopted.offered import axis_of
from tumble.calibrations.adopted.seen import Seen, seen
from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.tracing.explained import Explained
from tumble.messages import Message

AGREE_P: Final = 0.001
"""Below this chance a size is not that of the units on which the effect was found."""
_WITHIN: Final = 1.96
"""Standard uncertainties: 95% of a normal distribution."""
_LEAST: Final = 0.25
"""A unit with less than this of the mean size is none of those with the effect, however much they differ."""


def contradictions(explained: Explained[Any, Any], adopted: AdoptedEffect) -> Iterator[Message]:
    """What speaks against an effect in a run that was traced with it, as parts of a sentence; nothing where it holds.

    A run that does not show the variable, or not clearly enough to tell the effect from none, says nothing.
    """
    axis = axis_of(adopted, explained.table.axes)
    if axis is None:
        return
    run = seen(explained, axis, adopted.curve.knots, adopted.name)
    size, uncertainty = size_in(run, adopted)
    known = adopted.expected
    if not np.isfinite(uncertainty):
        return
    text, absent = format_concise(size, uncertainty, ""), abs(size) <= _WITHIN * uncertainty
    spread = known.standard_deviation if known else 0.0
    if absent and ndtr((size - max(1.0 - _WITHIN * spread, _LEAST)) / uncertainty) < AGREE_P:
        yield Message("it is not there: its size is {size}, where 1 is the mean of its units", size=text)
    elif known and not absent and 2.0 * ndtr(-abs(size - 1.0) / np.hypot(uncertainty, spread)) < AGREE_P:
        yield Message("its size is {size}, where its units have 1 and differ by {spread:.2g}", size=text, spread=spread)
    if not absent and left(run, adopted.curve, size):
        yield Message("it has another course: structure is left {phrase}", phrase=axis.coordinate.phrase)


def size_in(run: Seen, adopted: AdoptedEffect) -> tuple[float, float]:
    """Size of an effect by a run alone; its standard uncertainty holds what is not known of the course."""
    size, noise = run.along(adopted.curve.values)
    shown = run.design @ adopted.curve.values
    unknown = size * (run.design @ adopted.curve.parts).T @ shown / max(float(shown @ shown), 1e-300)
    return size, float(np.hypot(noise, np.linalg.norm(unknown)))
