"""What is stated of a gyrocompass: heading and drift by the declared model and with what was found."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit, fit_gyrocompass
from tumble.calibrations.methods.gyrocompass.geometry import wrapped_deg
from tumble.calibrations.methods.gyrocompass.model import NAMES, UNITS
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.held_out import held_out_rms
from tumble.calibrations.tracing.near_fits import averaged_over
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message

_DECIMALS: Final = 6
"""To so many a value that is given for an effect is stated: another machine must give the same."""
_FOLDS: Final = 6
"""Into so many parts the dwells are dealt for the held-out error where there are fewer realisations."""
_FEWEST_REALISATIONS: Final = 3


def silent(reason: str) -> ModelFit:
    """What is stated of a table in doubt."""
    unsaid = {name: Parameter(name=name, unit=UNITS[name], value=None, reason=reason) for name in NAMES}
    return ModelFit(parameters=unsaid, residual_rms=None, held_out_rms=None)


def modelled(
    table: GyrocompassTable, fit: GyrocompassFit, parameters: Mapping[str, Parameter], held_out: float | None
) -> ModelFit:
    """One of the two models."""
    residual = float(np.sqrt(np.mean(fit.residual[table.rates] ** 2)))
    return ModelFit(parameters=parameters, residual_rms=residual, held_out_rms=held_out)


def augmented(explained: Explained[GyrocompassTable, GyrocompassFit]) -> tuple[ModelFit, tuple[BudgetLine, ...]]:
    """The model with what was found, and the line of near explanations in its budget."""
    held_out = held_out_rms(explained.judged.tracer, explained.judged.trace, parts(explained.table))

    def refitted(trace: Trace) -> dict[str, Parameter]:
        return _near(fit_gyrocompass(explained.table, trace).parameters(), explained.best.values)

    parameters, lines = averaged_over(explained, _unless_rivals_differ(explained), refitted, _values)
    return modelled(explained.table, explained.best, parameters, held_out), lines


def _values(theta: FloatArray) -> dict[str, float]:
    return {"alpha0": float(np.rad2deg(theta[0])), "drift": float(theta[1])}


def _near(parameters: Mapping[str, Parameter], values: Mapping[str, float]) -> dict[str, Parameter]:
    """Parameters with α0 as an angle within half a turn of that of other values."""
    alpha0 = parameters["alpha0"]
    if alpha0.value is None:
        return dict(parameters)
    near = values["alpha0"] + wrapped_deg(alpha0.value - values["alpha0"])
    return {**parameters, "alpha0": replace(alpha0, value=near)}


def held_out_declared(table: GyrocompassTable, nothing: Trace) -> float | None:
    """Error of predicting held-out rates by the declared model."""
    errors: list[FloatArray] = []
    for out in parts(table):
        if not _tell(table, ~out):
            continue
        sample = table.sample_of(~out)
        fit = sample.whitened_fit(nothing.noise)
        theta = fit.fit(fit.split(np.empty((len(sample.turned(table.declared[~out][:, :1])), 0)))).declared
        errors.append(table.output[out] - table.declared[out] @ table.model.coefficients(theta))
    return float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) if errors else None


def _tell(table: GyrocompassTable, kept: BoolArray) -> bool:
    """Whether some rows tell all that the whole table does."""
    rank = [np.linalg.matrix_rank(rows * np.sqrt(table.weights[at, None])) for rows, at in
            ((table.declared, slice(None)), (table.declared[kept], kept))]  # fmt: skip
    return bool(rank[0] == rank[1])


def parts(table: GyrocompassTable) -> list[BoolArray]:
    """Parts of the rates: realisations, or dwells dealt out where there are few of these. Tilts are never held out."""
    scene = table.scene
    number = scene.realisation
    if int(number.max(initial=0)) + 1 < _FEWEST_REALISATIONS:
        number = np.arange(scene.dwells) % _FOLDS
    its = np.repeat(number, scene.outputs)
    return [(its == each) & table.rates for each in range(int(number.max(initial=0)) + 1)]


def with_headings(parameters: Mapping[str, Parameter], headings_deg: tuple[float, ...]) -> dict[str, Parameter]:
    """Parameters without a heading, and so without a drift, where the rates allow several headings."""
    if len(headings_deg) < 2:
        return dict(parameters)
    said = series([f"{each:.3f}°" for each in headings_deg], "or")
    reasons = {
        "alpha0": Message("these positions leave several headings: {headings}; take a third position", headings=said),
        "drift": Message("it hangs on which of several headings is true: {headings}", headings=said),
    }
    return {name: each.withheld(reasons[name]) for name, each in parameters.items()}


def _unless_rivals_differ(explained: Explained[GyrocompassTable, GyrocompassFit]) -> dict[str, Parameter]:
    """Parameters with what was found; without a value where explanations that are not told apart disagree."""
    parameters = explained.best.parameters()
    for name, rivals in explained.close.items():
        others = {rival.name: fit_gyrocompass(explained.table, rival.trace).values for rival in rivals}
        for key, parameter in parameters.items():
            parameters[key] = _checked(parameter, name, others)
    return parameters


def _checked(parameter: Parameter, name: str, others: Mapping[str, Mapping[str, float]]) -> Parameter:
    """A parameter, or why it has no value, with that which it has by each of the effects."""
    u, value = parameter.standard_uncertainty, parameter.value
    if u is None or value is None:
        return parameter
    by_effect = {other: values[parameter.name] for other, values in others.items()}
    differing = [each for each, its in by_effect.items() if abs(_difference(its, value, parameter.unit)) > u]
    if not differing:
        return parameter
    reason = Message(
        "it differs between {name} and {rivals}, which this experiment does not tell apart",
        name=name,
        rivals=series(differing, "or"),
    )
    given = {name: value} | {each: by_effect[each] for each in differing}
    return replace(parameter.withheld(reason), given={each: round(given[each], _DECIMALS) for each in sorted(given)})


def _difference(one: float, other: float, unit: str) -> float:
    return wrapped_deg(one - other) if unit == UNITS["alpha0"] else one - other
