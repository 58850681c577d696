"""What is stated of a triad: parameters by the declared model and with what was found, and how far each predicts."""

from collections.abc import Mapping

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.methods.triad.fit import TriadFit, fit_triad
from tumble.calibrations.methods.triad.model import INTERNAL, NAMES, UNITS, stated
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.calibrations.tracing.explained import Explained, unless_rivals_differ
from tumble.calibrations.tracing.held_out import held_out_rms
from tumble.calibrations.tracing.near_fits import averaged_over
from tumble.calibrations.tracing.trace import Trace

_FOLDS = 6
"""Into so many parts the positions are dealt for the held-out error, every repeat of one in the same part."""


def silent(reason: str) -> ModelFit:
    """What is stated of a table in doubt."""
    unsaid = {name: Parameter(name=name, unit=UNITS[name], value=None, reason=reason) for name in NAMES}
    return ModelFit(parameters=unsaid, residual_rms=None, held_out_rms=None)


def augmented(explained: Explained[TriadTable, TriadFit]) -> tuple[ModelFit, tuple[BudgetLine, ...]]:
    """The model with what was found, and the line of near explanations in its budget."""
    held_out_v = held_out_rms(explained.judged.tracer, explained.judged.trace, _parts(explained.table))

    def refitted(trace: Trace) -> dict[str, Parameter]:
        return fit_triad(explained.table, trace).parameters()

    parameters, lines = averaged_over(explained, _with_rivals(explained), refitted, _values)
    return modelled(explained.best, parameters, held_out_v), lines


def _values(theta: FloatArray) -> dict[str, float]:
    return dict(zip(NAMES, stated(theta).tolist(), strict=True))


def held_out_declared(table: TriadTable, nothing: Trace) -> float | None:
    """Error of predicting held-out positions by the declared model."""
    errors: list[FloatArray] = []
    for out in _parts(table):
        sample = table.sample_of(~out)
        fit = sample.whitened_fit(nothing.noise)
        theta = fit.fit(fit.split(np.empty((len(sample.turned(table.declared[~out][:, :1])), 0)))).theta
        errors.append(table.output[out] - table.declared[out] @ table.model.coefficients(theta[:INTERNAL]))
    return float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) if errors else None


def modelled(fit: TriadFit, parameters: Mapping[str, Parameter], held_out_v: float | None) -> ModelFit:
    """One of the two models."""
    residual_v = float(np.sqrt(np.mean(fit.residual**2)))
    return ModelFit(parameters=parameters, residual_rms=residual_v, held_out_rms=held_out_v)


def _with_rivals(explained: Explained[TriadTable, TriadFit]) -> dict[str, Parameter]:
    """Parameters with what was found, but those that depend on which of two near rivals is true."""
    parameters = explained.best.parameters()
    for name, rivals in explained.near.items():
        for rival in rivals:
            other = fit_triad(explained.table, rival.trace).values
            for key, value in zip(NAMES, other.tolist(), strict=True):
                parameters[key] = unless_rivals_differ(parameters[key], value, name, rival.name)
    return parameters


def _parts(table: TriadTable) -> list[np.ndarray[tuple[int, ...], np.dtype[np.bool_]]]:
    """Parts of the rows, whole positions with all their repeats and channels."""
    position = np.repeat(table.observations.positions, 3)
    return [position % _FOLDS == fold for fold in range(_FOLDS)]
