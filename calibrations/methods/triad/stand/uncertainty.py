"""What a stand record does not know of itself, in the uncertainty of the parameters of a run that it corrected."""

from dataclasses import replace

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.methods.triad.fit import TriadFit
from tumble.calibrations.methods.triad.model import INTERNAL, stated_slopes
from tumble.calibrations.methods.triad.stand.columns import form_of
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.calibrations.stand_records.corrections import Corrections


def widened(model: ModelFit, fit: TriadFit, table: TriadTable, corrections: Corrections) -> ModelFit:
    """The model with the record as one source of type B, its errors correlated as they are."""
    variance = np.diag(_covariance(fit, table, corrections))
    names = list(model.parameters)
    return replace(
        model,
        parameters={
            name: _with_type_b(model.parameters[name], float(variance[place])) for place, name in enumerate(names)
        },
    )


def _covariance(fit: TriadFit, table: TriadTable, corrections: Corrections) -> FloatArray:
    """Of the stated parameters by errors of the record, shape (14, 14): each shifts the fit as its column would."""
    root = np.sqrt(table.weights)[:, None]
    forms = [item.form.columns for item in fit.found]
    design = np.column_stack([table.declared @ table.model.slopes(fit.theta), *forms]) * root
    known = np.zeros((table.rows, len(corrections.values)))
    for term in corrections.terms:
        form = form_of(term, table.scene)
        if form is not None:
            known[:, corrections.place(term)] = form.columns
    shifts = stated_slopes(fit.theta) @ (np.linalg.pinv(design) @ (known * root))[:INTERNAL]
    return np.asarray(shifts @ corrections.covariance @ shifts.T)


def _with_type_b(parameter: Parameter, variance: float) -> Parameter:
    """Combined by root sum of squares; degrees of freedom by Welch and Satterthwaite, those of the record infinite."""
    type_a, freedom = parameter.standard_uncertainty, parameter.degrees_of_freedom
    if parameter.value is None or not type_a or freedom is None:
        return parameter
    combined = float(np.hypot(type_a, np.sqrt(variance)))
    effective = freedom * (combined / type_a) ** 4
    half = coverage_factor(effective) * combined
    return replace(
        parameter,
        standard_uncertainty=combined,
        degrees_of_freedom=effective,
        interval_95=(parameter.value - half, parameter.value + half),
    )
