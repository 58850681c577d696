"""Closing the loop on a table whose declared model is linear: what is left, and what that does to the parameters."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.tracing.effect import Quantity, Structure
from tumble.calibrations.tracing.explained import Explained, unless_rivals_differ
from tumble.calibrations.tracing.findings import EffectFound, Unexplained, effects_found
from tumble.calibrations.tracing.judged import judged
from tumble.calibrations.tracing.linear import LinearFit, fit_linear
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import nothing_found
from tumble.messages import Message

_T = TypeVar("_T", bound=Table)


@dataclass(frozen=True, kw_only=True)
class LinearExplained(Explained[_T, LinearFit]):
    """A table whose declared model is linear, what it was traced to, and what could stand in its place."""

    before: LinearFit
    """The declared model alone."""

    @property
    def withheld(self) -> tuple[str, ...]:
        """What would fit the rows and does not stand, in sentences; shapes without a name are left out."""
        return tuple(
            Message("{name} is not stated: {reason}.", name=each.name, reason=each.reason)
            for each in self.judged.withheld
            if not each.unnamed
        )

    def effects(self, fit: LinearFit) -> tuple[EffectFound, ...]:
        """What was found, in the order of the evidence, with the coefficients of a fit."""
        found = effects_found(self.table, self.judged, fit, self.close)
        return tuple(sorted(found, key=lambda effect: effect.p_value))

    @property
    def unexplained(self) -> tuple[Unexplained, ...]:
        """Structure that is there and that no effect of the catalogue explains, the largest first."""
        shown = [
            (float(np.std(item.form.columns @ self.best.coefficients[columns])), item)
            for item, columns in zip(self.best.found, self.best.columns, strict=True)
        ]
        return tuple(
            Unexplained(depends_on=item.effect.depends_on, description=item.effect.describe(item.form))
            for _, item in sorted(shown, key=lambda entry: -entry[0])
            if isinstance(item.effect, Structure)
        )


def explain_linear(table: _T, units: Mapping[str, str]) -> LinearExplained[_T]:
    """Trace what a linear declared model leaves; `units` names its parameters, each with its unit."""
    found = judged(table)
    trace = found.trace
    nothing = nothing_found(table)
    before, best = fit_linear(table, nothing, units), fit_linear(table, trace, units)
    return LinearExplained(judged=found, before=before, best=best)


def stated(explained: LinearExplained[Any], fit: LinearFit, units: Mapping[str, str]) -> dict[str, Parameter]:
    """Parameters with what was found, but those that depend on which of two near rivals is true."""
    parameters = as_stated(fit)
    for name, rivals in explained.near.items():
        for rival in rivals:
            other = fit_linear(explained.table, rival.trace, units)
            for key, quantity in other.parameters.items():
                parameters[key] = unless_rivals_differ(parameters[key], quantity.value, name, rival.name)
    return parameters


def withheld(units: Mapping[str, str], reason: str) -> ModelFit:
    """A model of which nothing is stated, and why: the table is to be asked about, or holds too little."""
    parameters = {name: Parameter(name=name, unit=unit, value=None, reason=reason) for name, unit in units.items()}
    return ModelFit(parameters=parameters, residual_rms=None, held_out_rms=None)


def rms(values: FloatArray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def as_stated(fit: LinearFit) -> dict[str, Parameter]:
    """Parameters as they were fitted."""
    return {name: _stated(name, quantity, fit.degrees_of_freedom) for name, quantity in fit.parameters.items()}


def _stated(name: str, quantity: Quantity, freedom: int) -> Parameter:
    value, uncertainty = quantity.value, quantity.standard_uncertainty
    alone = Parameter(name=name, unit=quantity.unit, value=value, standard_uncertainty=uncertainty)
    if not freedom or uncertainty is None:
        return alone
    half = coverage_factor(freedom) * uncertainty
    return replace(alone, degrees_of_freedom=freedom, interval_95=(value - half, value + half))


def withheld_json(explained: LinearExplained[Any]) -> list[dict[str, str]]:
    """What would fit the rows and does not stand."""
    return [{"name": each.name, "reason": each.reason} for each in explained.judged.withheld if not each.unnamed]


def model_json(model: ModelFit, unit: str) -> dict[str, Any]:
    """Parameters and error of one of the two models; keys end in the unit where it is given."""
    ending = f"_{unit}" if unit else ""
    return {
        "parameters": {name: _stated_json(parameter) for name, parameter in model.parameters.items()},
        f"residual_rms{ending}": model.residual_rms,
        f"held_out_rms{ending}": model.held_out_rms,
    }


def _stated_json(parameter: Parameter) -> dict[str, Any]:
    content = {"value": parameter.value, "standard_uncertainty": parameter.standard_uncertainty, "unit": parameter.unit}
    return content | ({"reason": parameter.reason} if parameter.value is None else {})
