"""What one run says of a course along one axis, beside the declared model and everything else that was found."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tumble.calibrations.adopted.knots import Knots
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.trace import Trace

_SEEN = 1e-10
"""Directions of which less than this part is left beside the declared model are not seen at all."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Seen:
    """A course f at the knots, as a run sees it: `output = design @ f` with independent noise of variance 1."""

    design: FloatArray
    """Shape (n, knots)."""
    output: FloatArray
    """Shape (n,)."""

    def along(self, values: FloatArray) -> tuple[float, float]:
        """So many times these values at the knots fit best, and its standard uncertainty (infinite where unseen)."""
        shown = self.design @ values
        square = float(shown @ shown)
        return (float(shown @ self.output) / square, square**-0.5) if square > 0.0 else (0.0, float("inf"))


def seen(explained: Explained[Any, Any], axis: Axis, knots: Knots, name: str = "") -> Seen:
    """What a run says of a course along an axis.

    Parameters
    ----------
    explained
        The run, traced. What it was traced to along the axis is what is asked for here.
    axis
        One of those of its table.
    knots
        Of the course.
    name
        Of the effect that is the course, where the run may have been traced to it.
    """
    table, trace = explained.table, _beside(explained.trace, axis, name)
    theta = table.fit(explained.trace.forms, explained.trace.noise).declared
    whiten, root = table.memory.whitening(trace.noise), np.sqrt(table.weights)
    functions = table.declared
    known = np.column_stack([functions @ table.model.slopes(theta), *(form.columns for form in trace.forms)])
    misfit = table.output - functions @ table.model.coefficients(theta)[: functions.shape[1]]
    course = axis.channel.gain[:, None] * knots.basis(axis.coordinate.values)
    columns = whiten(np.column_stack([course, misfit]) * root[:, None])
    span = _orthonormal(whiten(known * root[:, None]))
    rest = (columns - span @ (span.T @ columns)) / explained.best.dwell
    return _compressed(rest[:, :-1], rest[:, -1], float(np.max(np.abs(columns[:, :-1]))) / explained.best.dwell)


def _beside(trace: Trace, axis: Axis, name: str) -> Trace:
    """A trace without what it says along an axis."""
    for component in trace.components:
        if component.axis.key == axis.key:
            trace = trace.without(component.name)
    return trace.without(name) if name else trace


def _orthonormal(columns: FloatArray) -> FloatArray:
    norms = np.linalg.norm(columns, axis=0).clip(1e-300)
    vectors, sizes, _ = np.linalg.svd(columns / norms, full_matrices=False)
    return np.asarray(vectors[:, sizes > _SEEN * sizes[0]])


def _compressed(design: FloatArray, output: FloatArray, scale: float) -> Seen:
    """The same in as many rows as there are directions that are seen."""
    left, sizes, right = np.linalg.svd(design, full_matrices=False)
    kept = sizes > max(_SEEN**0.5 * scale, 1e-300)
    return Seen(design=sizes[kept, None] * right[kept], output=left[:, kept].T @ output)
