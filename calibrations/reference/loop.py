"""Closing the loop on a head that is measured against a reference."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from calibrations.blas_threads import one_blas_thread
from calibrations.geometry import FloatArray
from calibrations.observations import Observations, SetAside
from calibrations.reference.experiments import next_reference_experiments
from calibrations.reference.passes import Passes, passes
from calibrations.reference.questions import question
from calibrations.reference.scene import HeadScene
from calibrations.reference.table import UNITS, HeadTable, first_look, head_table
from calibrations.tracing.experiments import Experiment
from calibrations.tracing.findings import EffectFound, Unexplained
from calibrations.tracing.fitting_noise import best_walk
from calibrations.tracing.held_out import held_out_rms
from calibrations.tracing.linear import LinearFit, fit_linear
from calibrations.tracing.linear_loop import Explained, Model, as_stated, explain_linear, rms, stated
from calibrations.tracing.noise import NoiseModel
from calibrations.tracing.trace import trace_price

_LOOKS = 5
"""How often a table is looked at anew once it is known where the reference saw the head."""
_MOVED_DEG = 1e-4
"""A change of where the reference saw the head that changes nothing more."""
_GROSS = 6.0
"""A dwell so many times as far from its neighbours as all but one of twenty are is a gross error."""
_ROUNDING_DEG = 1e-6
"""Scatter below this is rounding."""
_PARTS = 10
"""A table is cut into so many stretches, each predicted from the others."""


@dataclass(frozen=True, kw_only=True)
class ReferenceLoop:
    """The loop closed on one table."""

    observations: Observations
    """The dwells that were used."""
    rows_read: int
    declared: Model
    augmented: Model
    effects: tuple[EffectFound, ...]
    unexplained: tuple[Unexplained, ...]
    dwell_deg: float
    """Standard deviation of a dwell about all that was found."""
    passes: Passes | None
    """How forward and backward passes differ; None where the head was turned in one direction only."""
    warnings: tuple[str, ...]
    explained: Explained[HeadTable]
    """What it rests on."""
    fit: LinearFit
    """The best fit with uncertainties that know that neighbouring dwells err alike."""

    @property
    def degrees_of_freedom(self) -> int:
        """Of the noise of a dwell."""
        return len(self.observations) - len(self.fit.coefficients) - len(UNITS)

    @cached_property
    def next_experiment(self) -> tuple[Experiment, ...]:
        """What would part the rivals that are left."""
        return next_reference_experiments(self.explained)


@one_blas_thread
def close_reference_loop(observations: Observations) -> ReferenceLoop:
    """Find what makes a reference differ from the head.

    Raises
    ------
    ValueError
        The table holds no reference, or no usable row.
    """
    if not len(observations):
        raise ValueError(f"{observations.source}: no usable row")
    asked = question(observations)
    table = first_look(observations)
    observations = _without(observations, table, _gross_errors(table.output))
    explained = _explained(_traceable(observations, asked))
    rejected = _gross_errors(explained.best.residual)
    if rejected.any():
        observations = _without(observations, explained.table, rejected)
        explained = _explained(_traceable(observations, asked))
    table, trace = explained.table, explained.trace
    known = _known_noise(explained)
    fit = fit_linear(table.wandering, replace(trace, noise=known), UNITS)
    parts = _stretches(table.rows)
    return ReferenceLoop(
        observations=replace(table.observations, set_aside=observations.set_aside),
        rows_read=observations.rows_read,
        declared=Model(
            parameters=as_stated(explained.before),
            residual_rms=rms(explained.before.residual),
            held_out_rms=_held_out_constant(table.output, parts),
        ),
        augmented=Model(
            parameters=stated(explained, fit, UNITS),
            residual_rms=rms(explained.best.residual),
            held_out_rms=held_out_rms(explained.tracer, trace, parts),
        ),
        effects=explained.effects(fit),
        unexplained=explained.unexplained,
        dwell_deg=explained.best.dwell,
        passes=passes(table, explained.before.residual, explained.best.residual),
        warnings=tuple(filter(None, (*observations.warnings, *asked, table.not_traced))),
        explained=explained,
        fit=fit,
    )


def _traceable(observations: Observations, asked: Sequence[str]) -> HeadTable:
    """The table; with nothing to be found in it where it must be asked about first."""
    table = first_look(observations)
    return replace(table, effects=(), structures=()) if asked else table


def _explained(table: HeadTable) -> Explained[HeadTable]:
    """Trace a table; again, where what was found says that the reference saw the head elsewhere."""
    looks = [explain_linear(table, UNITS)]
    for _ in range(_LOOKS):
        last = looks[-1]
        scene = _scene(last)
        if np.max(np.abs(scene.seen_deg - last.table.scene.seen_deg)) < _MOVED_DEG:
            break
        looks.append(explain_linear(head_table(scene), UNITS))
    return min(looks, key=lambda look: trace_price(look.trace))


def _scene(explained: Explained[HeadTable]) -> HeadScene:
    """The rows as they are to be seen by what was found."""
    scene, names = explained.table.scene, explained.trace.names
    late_s, short_deg = (
        explained.best.quantities(name)[name].value if name in names else 0.0 for name in ("latency", "backlash")
    )
    return replace(scene, late_s=late_s, short_deg=short_deg)


def _known_noise(explained: Explained[HeadTable]) -> NoiseModel:
    """The walk that what was found leaves, where it leaves one."""
    table, forms = explained.table.wandering, explained.trace.forms
    if not table.memory.modes.shape[1]:
        return NoiseModel()
    walk, deviance = best_walk(table, forms, NoiseModel())
    return walk if deviance < table.deviance(forms, NoiseModel()) else NoiseModel()


def _gross_errors(residual: FloatArray) -> NDArray[np.bool_]:
    """Dwells that lie far from their neighbours, shape (rows,), by what is left of the output."""
    around = np.array([np.median(residual[max(0, row - 3) : row + 4]) for row in range(len(residual))])
    away = np.abs(residual - around)
    return np.asarray(away > _GROSS * max(float(np.quantile(away, 0.95)), _ROUNDING_DEG))


def _without(observations: Observations, table: HeadTable, rejected: NDArray[np.bool_]) -> Observations:
    """The observations without the rows of these dwells of the table."""
    rows = observations.row[rejected[table.scene.dwells.number]]
    return observations.without(tuple(SetAside(row=int(row), reason="gross error", gross=True) for row in rows))


def _stretches(rows: int) -> Sequence[NDArray[np.bool_]]:
    """Which rows are held out together: neighbours, which err alike."""
    number = np.arange(rows) * _PARTS // rows
    return [number == part for part in range(min(_PARTS, rows))]


def _held_out_constant(output: FloatArray, parts: Sequence[NDArray[np.bool_]]) -> float | None:
    if len(output) < 2:
        return None
    error = np.concatenate([output[out] - output[~out].mean() for out in parts])
    return rms(error)
