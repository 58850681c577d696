"""The fourteen parameters with everything that makes them uncertain: budget, and its check by simulation."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine, Source, contributions, scatter_line, with_type_b
from tumble.calibrations.core.gravity import PerAcceleration, per_acceleration
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.propagation import MonteCarlo, Simulated, drawn_errors_v, simulated_json, summarised
from tumble.calibrations.methods.triad.budget import TwoAxisUncertainty, sources
from tumble.calibrations.methods.triad.fit import TriadFit
from tumble.calibrations.methods.triad.model import INTERNAL, NAMES, stated, stated_slopes
from tumble.calibrations.methods.triad.table import TriadTable

_ROUNDS = 3
"""Steps of a refit from the fitted parameters; each leaves of an error the part by which levels differ from theirs."""


@dataclass(frozen=True, kw_only=True)
class Budget:
    """On what the uncertainty of a model rests."""

    lines: tuple[BudgetLine, ...] = ()
    monte_carlo: Mapping[str, Simulated] = field(default_factory=dict)
    """What propagation of distributions gives, by name; empty where it was not asked for."""
    per_acceleration: Mapping[str, PerAcceleration] = field(default_factory=dict)
    """Empty where local gravity is not known."""

    def as_json(self) -> dict[str, Any]:
        """Under the keys that every method has for them."""
        return {
            "budget": [line.as_json() for line in self.lines],
            "monte_carlo": simulated_json(self.monte_carlo),
            "per_m_s2": {name: each.as_json() for name, each in self.per_acceleration.items()},
        }


@dataclass(frozen=True, kw_only=True)
class Assessed:
    """A model with its stand in its uncertainty."""

    fit: TriadFit
    model: ModelFit
    budget: Budget


def assessed(model: ModelFit, fit: TriadFit, table: TriadTable, stand: TwoAxisUncertainty, trials: int) -> Assessed:
    """A fitted model with what the stand adds to its uncertainty; with 0 `trials` there is no Monte Carlo check."""
    listed, slopes = sources(table.scene, stand), stated_slopes(fit.theta)
    errors_v = [source.turned(fit.compressed.rotation) for source in listed]
    shifts = [(fit.inverse @ each)[:INTERNAL] for each in errors_v]
    shared = sum((each @ each.T for each in shifts), np.zeros((INTERNAL, INTERNAL)))
    further = slopes @ shared @ slopes.T
    combined = replace(
        fit,
        internal_covariance=fit.internal_covariance + shared,
        parameter_covariance=fit.parameter_covariance + further,
    )
    parameters = {
        name: with_type_b(model.parameters[name], float(u))
        for name, u in zip(NAMES, np.sqrt(np.diag(further).clip(0.0)), strict=True)
    }
    told = [name for name, parameter in parameters.items() if parameter.value is not None]
    return Assessed(
        fit=combined,
        model=replace(model, parameters=parameters),
        budget=Budget(
            lines=_lines(fit, listed, [slopes @ each for each in shifts], told),
            monte_carlo=_simulated(fit, table, errors_v, trials).by_name(NAMES, told) if trials else {},
            per_acceleration=per_acceleration(parameters, stand.gravity) if stand.gravity else {},
        ),
    )


def _lines(
    fit: TriadFit, listed: Sequence[Source], shifts: Sequence[FloatArray], told: Sequence[str]
) -> tuple[BudgetLine, ...]:
    scatter = contributions(fit.parameter_covariance, NAMES, told)
    further = [
        source.line(contributions(shift @ shift.T, NAMES, told)) for source, shift in zip(listed, shifts, strict=True)
    ]
    return (scatter_line(fit.dwell, fit.degrees_of_freedom, scatter), *further)


def _simulated(fit: TriadFit, table: TriadTable, errors_v: Sequence[FloatArray], trials: int) -> MonteCarlo:
    """Simulate the rows anew and fit the full model to each, from the fitted parameters on."""
    r, model = fit.compressed.r, table.model
    together_v = np.column_stack([np.zeros((len(r), 1)), *errors_v])
    rows_v = r @ model.coefficients(fit.everything) + drawn_errors_v(
        fit.dwell, fit.degrees_of_freedom, together_v, trials
    )
    theta = np.tile(fit.everything, (trials, 1))
    for _ in range(_ROUNDS):
        theta += (rows_v - model.coefficients(theta) @ r.T) @ fit.inverse.T
    return summarised(stated(theta), fit.values)
