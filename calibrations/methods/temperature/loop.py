"""Closing the loop on parameters against temperature: each by itself, then what several of them share."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.repeats import PureError
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.temperature.columns import unit_of
from tumble.calibrations.methods.temperature.effects import CUBIC
from tumble.calibrations.methods.temperature.limits import limits
from tumble.calibrations.methods.temperature.scene import RunScene
from tumble.calibrations.methods.temperature.settled import RunTable, run_table, settled_runs
from tumble.calibrations.methods.temperature.shared import SharedCause, shared_causes
from tumble.calibrations.methods.temperature.table import Runs
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.linear_loop import LinearExplained, as_stated, explain_linear, rms, stated, withheld
from tumble.calibrations.tracing.quantified import form_in
from tumble.calibrations.tracing.sentences import nothing_looked_for
from tumble.messages import Message

_POLYNOMIALS = (Message("constant"), Message("line"), Message("parabola"), Message("cubic"))
"""By their degree."""
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
    """Of runs at a temperature, predicted from those at others."""

    @property
    def words(self) -> Message:
        """How it is called."""
        return _POLYNOMIALS[self.power]


@dataclass(frozen=True, kw_only=True)
class ParameterLoop:
    """The loop closed on one parameter."""

    name: str
    unit: str
    declared: ModelFit
    """A constant."""
    polynomials: tuple[Polynomial, ...]
    augmented: ModelFit
    effects: tuple[EffectFound, ...]
    explained: LinearExplained[RunTable]
    """Of the means of what was run at one temperature, reached from one side."""
    residual: FloatArray
    """What is left of every run, shape (runs,)."""
    pure_error: PureError | None
    """Scatter of runs at one temperature, in the square of the unit; None where none was visited twice."""

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
    temperatures: int
    """How many different ones were visited."""
    shared: tuple[SharedCause, ...]
    limits: tuple[str, ...]
    """What is not identifiable from these runs, in sentences, each with the experiment that would help."""


@one_blas_thread
def close_temperature_loop(runs: Runs) -> TemperatureLoop:
    """Trace every parameter of a table of runs, and find causes that several of them share."""
    scene = _scene(runs)
    parameters = tuple(_parameter(scene, name, values) for name, values in runs.parameters.items())
    explained = {parameter.name: parameter.explained for parameter in parameters}
    shared = shared_causes(explained)
    few = next((one.table.not_traced for one in explained.values()), "")
    sentences = (
        *([nothing_looked_for(few)] if few else []),
        *limits(runs, explained, shared),
        *_only_described(parameters),
    )
    return TemperatureLoop(
        runs=runs,
        parameters=parameters,
        temperatures=len(scene.known_degc),
        shared=shared,
        limits=sentences,
    )


def _only_described(parameters: Sequence[ParameterLoop]) -> Iterator[str]:
    """Where what was found says less of a run that is left out than a polynomial does."""
    worse = [
        Message("{name} (degree {degree})", name=each.name, degree=each.best_polynomial.power)
        for each in parameters
        if each.only_describes
    ]
    if worse:
        yield Message(
            "What was found in {parameters} describes these runs, but a polynomial of the degree that is given "
            "predicts a run that is left out better: until there are more runs, correct with that.",
            parameters=series(worse),
        )


def _parameter(scene: RunScene, name: str, values: FloatArray) -> ParameterLoop:
    unit = unit_of(name)
    units: Mapping[str, str] = {"constant": unit}
    settled = settled_runs(scene, values, unit)
    explained = explain_linear(settled.table, units)
    powers = range(min(HIGHEST_POWER, max(len(scene.known_degc) - 2, 0)) + 1)
    polynomials = tuple(_polynomial(scene, values, power) for power in powers)
    few = settled.table.not_traced
    return ParameterLoop(
        name=name,
        unit=unit,
        declared=withheld(units, few)
        if few
        else ModelFit(
            parameters=as_stated(explained.before),
            residual_rms=rms(values - values.mean()),
            held_out_rms=polynomials[0].held_out_rms,
        ),
        polynomials=polynomials,
        augmented=withheld(units, few)
        if few
        else ModelFit(
            parameters=stated(explained, explained.best, units),
            residual_rms=rms(settled.residual(explained)),
            held_out_rms=settled.with_repeats(_held_out(settled.table, units)),
        ),
        effects=tuple(sorted((*explained.effects(explained.best), *settled.drift), key=lambda each: each.p_value)),
        explained=explained,
        residual=settled.residual(explained),
        pure_error=settled.pure_error,
    )


def _scene(runs: Runs) -> RunScene:
    hours = None if runs.time_s is None else (runs.time_s - runs.time_s.min()) / 3600.0
    made = np.argsort(runs.order, kind="stable")
    direction = np.zeros(len(runs), dtype=np.int64)
    direction[made[1:]] = np.sign(np.diff(runs.temperature_degc[made]))
    return RunScene(temperature_degc=runs.temperature_degc, order=runs.order, hours=hours, direction=direction)


def _held_out(table: RunTable, units: Mapping[str, str]) -> float:
    """Root mean square error of predicting each temperature after tracing the others."""
    scene = table.runs
    return rms(np.concatenate([_missed(table, scene.at != number, units) for number in range(len(scene.known_degc))]))


def _missed(table: RunTable, kept: NDArray[np.bool_], units: Mapping[str, str]) -> FloatArray:
    """What the runs that are left out show beyond what the others predict for them."""
    scene = table.runs
    best = explain_linear(run_table(scene.only(kept), table.output[kept], table.unit), units).best
    forms = [form_in(scene.over(scene.only(kept)), item).columns @ best.coefficients[columns]
             for item, columns in zip(best.found, best.columns, strict=True)]  # fmt: skip
    predicted = best.parameters["constant"].value + sum(forms, np.zeros(table.rows))
    return np.asarray((table.output - predicted)[~kept])


def _polynomial(scene: RunScene, values: FloatArray, power: int) -> Polynomial:
    temperature_degc = scene.temperature_degc
    left = values - np.polynomial.Polynomial.fit(temperature_degc, values, power)(temperature_degc)
    errors = []
    for out in range(len(scene.known_degc)):
        kept = scene.at != out
        fitted = np.polynomial.Polynomial.fit(temperature_degc[kept], values[kept], power)
        errors.append(values[~kept] - fitted(temperature_degc[~kept]))
    deviation = float(left.std(ddof=1))
    return Polynomial(power=power, standard_deviation=deviation, held_out_rms=rms(np.concatenate(errors)))
