"""Closing the loop on a table whose declared model is linear: what is left, and what that does to the parameters."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

import numpy as np

from tumble.calibrations.effects.effect import Quantity, Structure
from tumble.calibrations.geometry import FloatArray
from tumble.calibrations.tracing.findings import EffectFound, Unexplained, effects_found
from tumble.calibrations.tracing.judged import Judged, judged
from tumble.calibrations.tracing.linear import LinearFit, fit_linear
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.rivals import CLOSE, Rival
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.taken_back import RIVALS_APART
from tumble.calibrations.tracing.trace import Trace, Tracer

_T = TypeVar("_T", bound=Table)


@dataclass(frozen=True, kw_only=True)
class Stated:
    """A parameter as it is stated: a quantity, or why it has no value."""

    unit: str
    value: float | None = None
    standard_uncertainty: float | None = None
    reason: str = ""


@dataclass(frozen=True, kw_only=True)
class Model:
    """One of the two models of a table: declared, or with what was found."""

    parameters: Mapping[str, Stated]
    residual_rms: float | None
    """None where nothing is stated."""
    held_out_rms: float | None
    """On rows that neither chose an effect nor fitted its coefficients; None where too few remain."""


@dataclass(frozen=True, kw_only=True)
class Explained(Generic[_T]):
    """A table, what it was traced to, and what could stand in its place."""

    judged: Judged[_T]
    before: LinearFit
    """The declared model alone."""
    best: LinearFit
    """With what was found."""

    @property
    def tracer(self) -> Tracer[_T]:
        """The table with everything that it may be traced to."""
        return self.judged.tracer

    @property
    def trace(self) -> Trace:
        """What it was traced to."""
        return self.judged.trace

    @property
    def near(self) -> Mapping[str, Sequence[Rival]]:
        """Near rivals of each effect of the trace."""
        return self.judged.near

    @property
    def withheld(self) -> tuple[str, ...]:
        """What would fit the rows and does not stand, in sentences; shapes without a name are not told of."""
        return tuple(f"{each.name} is not stated: {each.reason}." for each in self.judged.withheld if not each.unnamed)

    @property
    def table(self) -> _T:
        """The table."""
        return self.tracer.ground

    @property
    def close(self) -> dict[str, list[Rival]]:
        """Rivals of each effect that cannot be told from it."""
        return {name: [rival for rival in near if rival.behind < CLOSE] for name, near in self.near.items()}

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


def explain_linear(table: _T, units: Mapping[str, str]) -> Explained[_T]:
    """Trace what a linear declared model leaves; `units` names its parameters, each with its unit."""
    found = judged(table)
    trace = found.trace
    nothing = Trace(found=(), noise=NoiseModel(), deviance=table.deviance((), NoiseModel()))
    before, best = fit_linear(table, nothing, units), fit_linear(table, trace, units)
    return Explained(judged=found, before=before, best=best)


def stated(explained: Explained[Any], fit: LinearFit, units: Mapping[str, str]) -> dict[str, Stated]:
    """Parameters with what was found, but those that depend on which of two near rivals is true."""
    parameters = {name: _stated(quantity) for name, quantity in fit.parameters.items()}
    for name, rivals in explained.near.items():
        for rival in rivals:
            other = fit_linear(explained.table, rival.trace, units)
            for key, quantity in other.parameters.items():
                parameters[key] = _judged(parameters[key], quantity.value, name, rival.name)
    return parameters


def withheld(units: Mapping[str, str], reason: str) -> Model:
    """A model of which nothing is stated, and why: the table is to be asked about, or holds too little."""
    parameters = {name: Stated(unit=unit, reason=reason) for name, unit in units.items()}
    return Model(parameters=parameters, residual_rms=None, held_out_rms=None)


def rms(values: FloatArray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def as_stated(fit: LinearFit) -> dict[str, Stated]:
    """Parameters as they were fitted."""
    return {name: _stated(quantity) for name, quantity in fit.parameters.items()}


def _stated(quantity: Quantity) -> Stated:
    return Stated(unit=quantity.unit, value=quantity.value, standard_uncertainty=quantity.standard_uncertainty)


def _judged(parameter: Stated, other: float, name: str, rival: str) -> Stated:
    if parameter.value is None or parameter.standard_uncertainty is None:
        return parameter
    if abs(other - parameter.value) <= RIVALS_APART * parameter.standard_uncertainty:
        return parameter
    reason = f"it differs between {name} and {rival}, which this table does not clearly tell apart"
    return replace(parameter, value=None, standard_uncertainty=None, reason=reason)


def withheld_json(explained: Explained[Any]) -> list[dict[str, str]]:
    """What would fit the rows and does not stand."""
    return [{"name": each.name, "reason": each.reason} for each in explained.judged.withheld if not each.unnamed]


def model_json(model: Model, unit: str) -> dict[str, Any]:
    """Parameters and error of one of the two models; keys end in the unit where it is given."""
    ending = f"_{unit}" if unit else ""
    return {
        "parameters": {name: _stated_json(parameter) for name, parameter in model.parameters.items()},
        f"residual_rms{ending}": model.residual_rms,
        f"held_out_rms{ending}": model.held_out_rms,
    }


def _stated_json(parameter: Stated) -> dict[str, Any]:
    content = {"value": parameter.value, "standard_uncertainty": parameter.standard_uncertainty, "unit": parameter.unit}
    return content | ({"reason": parameter.reason} if parameter.value is None else {})
