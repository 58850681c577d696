"""The error before and after, on rows that neither chose an effect nor fitted its coefficients."""

import numpy as np

from calibrations.adequacy import held_out_parts
from calibrations.model import coefficients
from calibrations.tracing.problem import Problem
from calibrations.tracing.search import search
from calibrations.tracing.trace import Trace, Tracer


def held_out_rms(tracer: Tracer, trace: Trace) -> float | None:
    """Root mean square error, in volts, of predicting held-out rows after a search among the others.

    Effects are chosen anew from the other rows, from their scans as they stand, in the noise of the whole table. What
    is drawn at random (levels, a walk) cannot be predicted and counts as error. None where too few rows remain.
    """
    ground = tracer.ground
    output_v, error = ground.joint.observations.output_v, np.empty(ground.rows)
    offered = [candidate for candidate in tracer.offered if not candidate.effect.drawn]
    for out in held_out_parts(ground.joint.observations):
        if np.count_nonzero(~out) < ground.declared.shape[1]:
            return None
        sample = ground.sample_of(~out)
        problem = Problem(sample.footing(trace.noise), sample.turned(tracer.columns[~out]), offered)
        explanation = search(problem, beam=1)
        columns = np.column_stack([ground.declared, tracer.columns[:, problem.columns_of(explanation.chosen)]])
        error[out] = output_v[out] - columns[out] @ coefficients(problem.parameters(explanation))
    return float(np.sqrt(np.mean(error**2)))
