"""Heading and drift with everything that makes them uncertain: budget, and its check by simulation."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine, contributions, with_type_b
from tumble.calibrations.core.parameter import ModelFit
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
        name: with_type_b(model.parameters[name], float(u))
        for name, u in zip(NAMES, np.sqrt(np.diag(shared).clip(0.0)), strict=True)
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
