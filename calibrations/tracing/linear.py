"""A linear declared model with what was found, fitted by generalised least squares."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.solutions import smallest_solution
from tumble.calibrations.tracing.effect import Quantity
from tumble.calibrations.tracing.quantified import Quantified, expectations, slices, tangent
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace

_UNSEEN = 1e-9
"""Directions weaker than this, relative to the strongest, have no variance to be stated."""


@dataclass(frozen=True, kw_only=True)
class LinearFit(Quantified):
    """Parameters of a linear model beside the coefficients of what was found."""

    parameters: Mapping[str, Quantity]
    together: FloatArray
    """Covariance of parameters and coefficients together, in that order."""
    degrees_of_freedom: int
    """Of the scatter of the rows: as many as were not fitted away."""


def fit_linear(table: Table, trace: Trace, units: Mapping[str, str]) -> LinearFit:
    """Fit a linear declared model with what was found; `units` names its parameters, each with its unit.

    What was scanned for counts as fitted: the change of each form with its scanned value is a column of its own.
    """
    found, size = trace.found, table.model.parameters
    places = slices([item.form.columns.shape[1] for item in found])
    forms = [item.form.columns for item in found]
    first, _, _, dwell = _solve(table, trace, forms)
    changes = [tangent(table.scene, item, first[size:][place]) for item, place in zip(found, places, strict=True)]
    columns = [*forms, *(change for change in changes if change is not None)]
    known = [(size + place, value, weight) for place, value, weight in expectations(found, places, dwell)]
    unknown = [
        float(first[size:][place][0]) * item.effect.unknown(table.scene)
        for item, place in zip(found, places, strict=True)
        if item.effect.unknown is not None
    ]
    theta, scatter, residual, dwell = _solve(table, trace, columns, known, unknown)
    numbers = iter(range(places[-1].stop if places else 0, len(theta) - size))
    root = np.sqrt(np.diag(scatter))
    return LinearFit(
        found=found,
        columns=tuple(places),
        scanned=tuple(None if change is None else next(numbers) for change in changes),
        coefficients=theta[size:],
        covariance=scatter[size:, size:],
        residual=residual,
        dwell=dwell,
        parameters={
            name: Quantity(value=float(theta[place]), standard_uncertainty=float(root[place]), unit=unit)
            for place, (name, unit) in enumerate(units.items())
        },
        together=scatter,
        degrees_of_freedom=max(table.rows - len(theta), 0),
    )


def _solve(
    table: Table,
    trace: Trace,
    further: Sequence[FloatArray],
    known: Sequence[tuple[int, float, float]] = (),
    unknown: Sequence[FloatArray] = (),
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Coefficients of all columns, their covariance, the residual of the rows, standard deviation of a row.

    `known` is what is known of coefficients beforehand, see `quantified.expectations`; `unknown` what errors of one
    standard uncertainty add to the rows.
    """
    whiten, root = table.memory.whitening(trace.noise), np.sqrt(table.weights)
    columns = np.column_stack([table.declared, *further])
    white, output = whiten(columns * root[:, None]), whiten(table.output * root)
    for place, value, weight in known:
        white = np.vstack([white, weight * (np.arange(columns.shape[1]) == place)])
        output = np.append(output, weight * value)
    q, r = np.linalg.qr(white)
    theta = smallest_solution(r, q.T @ output)
    squares = float(np.sum((output - white @ theta) ** 2))
    variance = squares / max(table.rows - columns.shape[1], 1)
    misfit = (table.output - columns @ theta) * root
    residual = np.asarray(whiten(whiten(misfit)) / root)  # best linear unbiased prediction (Henderson 1975)
    inverse = np.linalg.pinv(r, rcond=_UNSEEN)
    scatter = variance * inverse @ inverse.T
    for errors in unknown:
        shift = inverse @ (q[: table.rows].T @ whiten(errors * root[:, None]))
        scatter = scatter + shift @ shift.T
    return theta, np.asarray(scatter), residual, float(np.sqrt(variance))
