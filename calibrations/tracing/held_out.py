"""The error before and after, on rows that neither chose an effect nor fitted its coefficients."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from calibrations.tracing.problem import Problem
from calibrations.tracing.search import search
from calibrations.tracing.trace import Trace, Tracer


def held_out_rms(tracer: Tracer[Any], trace: Trace, parts: Iterable[NDArray[np.bool_]]) -> float | None:
    """Root mean square error of predicting each of the parts, rows held out, after a search among the others.

    Effects are chosen anew from the other rows, from their scans as they stand, in the noise of the whole table. What
    is drawn at random (levels, a walk) cannot be predicted and counts as error. None where too few rows remain.
    """
    ground = tracer.ground
    error = np.empty(ground.rows)
    searched = () if ground.not_traced else tracer.offered
    offered = [candidate for candidate in searched if not candidate.effect.drawn]
    for out in parts:
        if np.count_nonzero(~out) < ground.declared.shape[1]:
            return None
        sample = ground.sample_of(~out)
        problem = Problem(
            sample.footing(trace.noise), sample.turned(tracer.columns[~out]), offered, ground.most_effects
        )
        explanation = search(problem, beam=1)
        columns = np.column_stack([ground.declared, tracer.columns[:, problem.columns_of(explanation.chosen)]])
        error[out] = ground.output[out] - columns[out] @ ground.model.coefficients(problem.parameters(explanation))
    return float(np.sqrt(np.mean(error**2)))
