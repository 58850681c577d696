"""Closing the loop on parameters against temperature: each by itself, then what several of them share."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibrations.blas_threads import one_blas_thread
from calibrations.geometry import FloatArray
from calibrations.support import series
from calibrations.temperature.effects import CUBIC, run_effects
from calibrations.temperature.scene import RunScene
from calibrations.temperature.shared import SharedCause, shared_causes
from calibrations.temperature.table import Runs, unit_of
from calibrations.temperature.unknowable import cannot_be_known
from calibrations.tracing.declared import Linear
from calibrations.tracing.findings import EffectFound
from calibrations.tracing.linear_loop import Explained, Model, as_stated, explain_linear, rms, stated
from calibrations.tracing.noise import Memory
from calibrations.tracing.quantified import form_in
from calibrations.tracing.table import Table

_WORSE = 1.1
"""A larger error of runs left out, by more than this, is a worse prediction."""
HIGHEST_POWER = 3
"""Of the polynomials that are stated beside what was found."""


@dataclass(frozen=True, kw_only=True)
class Polynomial:
    """Least squares by a polynomial of the temperature: what is usually printed."""

    power: int
    standard_deviation: float
    """Of what it leaves, divisor runs - 1."""
    held_out_rms: float
    """Of runs predicted from the others."""


@dataclass(frozen=True, kw_only=True)
class ParameterLoop:
    """The loop closed on one parameter."""

    name: str
    unit: str
    declared: Model
    """A constant."""
    polynomials: tuple[Polynomial, ...]
    augmented: Model
    effects: tuple[EffectFound, ...]
    explained: Explained[Table]

    @property
    def best_polynomial(self) -> Polynomial:
        """The one that predicts runs left out best."""
        return min(self.polynomials, key=lambda polynomial: polynomial.held_out_rms)

    @property
    def only_describes(self) -> bool:
        """Whether more than a cubic was found, which says less of a run that is left out than a polynomial does."""
        beyond = any(effect.name not in CUBIC for effect in self.effects)
        held_out = self.augmented.held_out_rms
        return beyond and held_out is not None and held_out > _WORSE * self.best_polynomial.held_out_rms


@dataclass(frozen=True, kw_only=True)
class TemperatureLoop:
    """The loop closed on a table of runs."""

    runs: Runs
    parameters: tuple[ParameterLoop, ...]
    shared: tuple[SharedCause, ...]
    unknowable: tuple[str, ...]
    """What these runs cannot tell, in sentences, each with the experiment that would."""


@one_blas_thread
def close_temperature_loop(runs: Runs) -> TemperatureLoop:
    """Trace every parameter of a table of runs, and find causes that several of them share."""
    parameters = tuple(_parameter(runs, name, values) for name, values in runs.parameters.items())
    explained = {parameter.name: parameter.explained for parameter in parameters}
    shared = shared_causes(explained)
    few = next((one.table.not_traced for one in explained.values()), "")
    unknowable = (
        *([f"Nothing is looked for: {few}."] if few else []),
        *cannot_be_known(runs, explained, shared),
        *_only_described(parameters),
    )
    return TemperatureLoop(runs=runs, parameters=parameters, shared=shared, unknowable=unknowable)


def _only_described(parameters: Sequence[ParameterLoop]) -> Iterator[str]:
    """Where what was found says less of a run that is left out than a polynomial does."""
    worse = [f"{each.name} (degree {each.best_polynomial.power})" for each in parameters if each.only_describes]
    if worse:
        yield (
            f"What was found in {series(worse)} describes these runs, but a polynomial of the degree that is given "
            "predicts a run that is left out better: until there are more runs, correct with that."
        )


def _parameter(runs: Runs, name: str, values: FloatArray) -> ParameterLoop:
    unit = unit_of(name)
    units: Mapping[str, str] = {"constant": unit}
    table = run_table(_scene(runs), values, unit)
    explained = explain_linear(table, units)
    return ParameterLoop(
        name=name,
        unit=unit,
        declared=Model(
            parameters=as_stated(explained.before),
            residual_rms=rms(explained.before.residual),
            held_out_rms=_polynomial(runs, values, 0).held_out_rms,
        ),
        polynomials=tuple(_polynomial(runs, values, power) for power in range(min(HIGHEST_POWER, len(runs) - 2) + 1)),
        augmented=Model(
            parameters=stated(explained, explained.best, units),
            residual_rms=rms(explained.best.residual),
            held_out_rms=_held_out(table, units),
        ),
        effects=explained.effects(explained.best),
        explained=explained,
    )


def _scene(runs: Runs) -> RunScene:
    hours = None if runs.time_s is None else (runs.time_s - runs.time_s.min()) / 3600.0
    return RunScene(temperature_degc=runs.temperature_degc, order=runs.order, hours=hours)


def run_table(scene: RunScene, values: FloatArray, unit: str) -> Table:
    """The runs of one parameter as a table that may be traced."""
    rows = len(values)
    return Table(
        model=Linear(functions=np.ones((rows, 1))),
        output=values,
        unit=unit,
        weights=np.ones(rows),
        scene=scene,
        effects=run_effects(unit),
        structures=(),
        memory=Memory(modes=np.empty((rows, 0))),
    )


def _held_out(table: Table, units: Mapping[str, str]) -> float:
    """Root mean square error of predicting each run after tracing the others."""
    scene = table.scene
    assert isinstance(scene, RunScene), "run_table makes it"
    errors = [_missed(table, scene, np.arange(table.rows) != out, units) for out in range(table.rows)]
    return rms(np.array(errors))


def _missed(table: Table, scene: RunScene, kept: NDArray[np.bool_], units: Mapping[str, str]) -> float:
    """What the run that is left out shows beyond what the others predict for it."""
    best = explain_linear(run_table(scene.only(kept), table.output[kept], table.unit), units).best
    forms = [form_in(scene.over(scene.only(kept)), item).columns @ best.coefficients[columns]
             for item, columns in zip(best.found, best.columns, strict=True)]  # fmt: skip
    predicted = best.parameters["constant"].value + sum(forms, np.zeros(table.rows))
    return float((table.output - predicted)[~kept][0])


def _polynomial(runs: Runs, values: FloatArray, power: int) -> Polynomial:
    temperature_degc = runs.temperature_degc
    left = values - np.polynomial.Polynomial.fit(temperature_degc, values, power)(temperature_degc)
    errors = []
    for out in range(len(values)):
        kept = np.arange(len(values)) != out
        fitted = np.polynomial.Polynomial.fit(temperature_degc[kept], values[kept], power)
        errors.append(values[out] - fitted(temperature_degc[out]))
    deviation = float(left.std(ddof=1))
    return Polynomial(power=power, standard_deviation=deviation, held_out_rms=rms(np.array(errors)))
