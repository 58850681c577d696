"""Heading and drift with everything that makes them uncertain: budget, and its check by simulation."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine, contributions, effective_freedom
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.core.propagation import MonteCarlo, Simulated, drawn_errors_v, simulated_json, summarised
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.methods.gyrocompass.budget import TurntableUncertainty, sources
from tumble.calibrations.methods.gyrocompass.fit import STATED, GyrocompassFit
from tumble.calibrations.methods.gyrocompass.model import NAMES
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.messages import Message

_ROUNDS = 3
"""Steps of a refit from the fitted parameters."""
_TO_STATED: Final = np.array([np.rad2deg(1.0), 1.0])


@dataclass(frozen=True, kw_only=True)
class Budget:
    """On what the uncertainty of a model rests."""

    lines: tuple[BudgetLine, ...] = ()
    monte_carlo: Mapping[str, Simulated] = field(default_factory=dict)
    """What propagation of distributions gives, by name; empty where it was not asked for."""

    def as_json(self) -> dict[str, Any]:
        """Under the keys that every method has for them."""
        return {
            "budget": [line.as_json() for line in self.lines],
            "monte_carlo": simulated_json(self.monte_carlo),
        }


def assessed(
    model: ModelFit, fit: GyrocompassFit, table: GyrocompassTable, stand: TurntableUncertainty, trials: int
) -> tuple[ModelFit, Budget]:
    """A model with what the stand adds to its uncertainty; with 0 `trials` there is no Monte Carlo check."""
    listed = sources(table.scene, stand)
    errors = [source.turned(fit.compressed.rotation) for source in listed]
    shifts = [_TO_STATED[:, None] * (fit.inverse @ each)[:STATED] for each in errors]
    shared = sum((each @ each.T for each in shifts), np.zeros((STATED, STATED)))
    parameters = {
        name: _combined(model.parameters[name], float(variance))
        for name, variance in zip(NAMES, np.diag(fit.parameter_covariance + shared), strict=True)
    }
    told = [name for name, parameter in parameters.items() if parameter.value is not None]
    scatter = BudgetLine(
        name=Message("scatter of the data"),
        kind="A",
        symbol=Message("{scatter} a dwell", scatter=format_number(fit.dwell, "°/h")),
        contributions=contributions(fit.parameter_covariance, NAMES, told),
        degrees_of_freedom=fit.degrees_of_freedom,
    )
    further = [
        source.line(contributions(shift @ shift.T, NAMES, told)) for source, shift in zip(listed, shifts, strict=True)
    ]
    simulated = _simulated(fit, table, errors, trials).by_name(NAMES, told) if trials else {}
    return replace(model, parameters=parameters), Budget(lines=(scatter, *further), monte_carlo=simulated)


def _combined(parameter: Parameter, variance: float) -> Parameter:
    """By root sum of squares; degrees of freedom by Welch and Satterthwaite, those of type B infinite."""
    type_a, freedom = parameter.type_a, parameter.degrees_of_freedom
    if parameter.value is None or type_a is None or freedom is None:
        return parameter
    combined = float(np.sqrt(variance))
    effective = effective_freedom([(type_a, freedom), (float(np.sqrt(max(variance - type_a**2, 0.0))), np.inf)])
    half = coverage_factor(effective) * combined
    return replace(
        parameter,
        standard_uncertainty=combined,
        degrees_of_freedom=effective,
        interval_95=(parameter.value - half, parameter.value + half),
    )


def _simulated(fit: GyrocompassFit, table: GyrocompassTable, errors: Sequence[FloatArray], trials: int) -> MonteCarlo:
    """Simulate the rows anew and fit the full model to each, from the fitted parameters on."""
    r, model = fit.compressed.r, table.model
    together = np.column_stack([np.zeros((len(r), 1)), *errors])
    rows = r @ model.coefficients(fit.everything) + drawn_errors_v(fit.dwell, fit.degrees_of_freedom, together, trials)
    theta = np.tile(fit.everything, (trials, 1))
    for _ in range(_ROUNDS):
        theta += (rows - model.coefficients(theta) @ r.T) @ fit.inverse.T
    value = np.array([fit.values["alpha0"], fit.values["drift"]])
    off = (theta[:, :STATED] - fit.everything[:STATED]) * _TO_STATED
    return summarised(value + off, value)
