"""The error before and after, on rows that neither chose an effect nor fitted its coefficients."""

from collections.abc import Iterable
from itertools import compress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.adequacy import told_without
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.problem import Problem
from tumble.calibrations.tracing.search import search
from tumble.calibrations.tracing.trace import Trace, Tracer


def held_out_rms(tracer: Tracer[Any], trace: Trace, parts: Iterable[NDArray[np.bool_]]) -> float | None:
    """Root mean square error of predicting each of the parts, rows held out, after a search among the others.

    Effects are chosen anew from the other rows, from their scans as they stand, in the noise of the whole table. What
    is random (levels, a walk) cannot be predicted and counts as error. Parts without which the others do not
    tell the declared model are passed over; None where that is every one.
    """
    table = tracer.table
    columns = table.declared @ table.model.slopes(table.fit((), trace.noise).declared)
    errors = [_errors(tracer, trace, out) for out in parts if told_without(columns, out)]
    return float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) if errors else None


def _errors(tracer: Tracer[Any], trace: Trace, out: NDArray[np.bool_]) -> FloatArray:
    """Output minus what the other rows predict, of the rows that are held out."""
    table = tracer.table
    barred = [candidate.effect.random or candidate.effect.name in tracer.barred for candidate in tracer.offered]
    offered = [] if table.not_traced else list(compress(tracer.offered, np.logical_not(barred)))
    sample = table.sample_of(~out)
    problem = Problem(
        sample.whitened_fit(trace.noise), sample.turned(tracer.columns[~out]), offered, table.most_effects
    )
    explanation = search(problem, beam=1)
    columns = np.column_stack([table.declared, tracer.columns[:, problem.columns_of(explanation.chosen)]])
    predicted = columns[out] @ table.model.coefficients(problem.parameters(explanation))
    return np.asarray(table.output[out] - predicted)
