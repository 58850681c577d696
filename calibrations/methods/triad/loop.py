"""Closing the loop on a triad: what the declared model leaves, traced; parameters before and after."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.repeats import PureError, pure_error
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.triad.assessed import Budget
from tumble.calibrations.methods.triad.doubts import doubts
from tumble.calibrations.methods.triad.experiments import next_experiments
from tumble.calibrations.methods.triad.fit import TriadFit, fit_triad
from tumble.calibrations.methods.triad.gross import gross_errors
from tumble.calibrations.methods.triad.models import augmented, held_out_declared, modelled, silent
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.readmitted import still_gross
from tumble.calibrations.methods.triad.scalar import ScalarFit, fit_scalar
from tumble.calibrations.methods.triad.table import TriadTable, triad_table
from tumble.calibrations.methods.triad.weights import channel_weights
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.findings import (
    EffectFound,
    Unexplained,
    Withheld,
    effects_found,
    unexplained,
    withheld,
)
from tumble.calibrations.tracing.judged import Judged, judged
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.scan import Scan
from tumble.calibrations.tracing.trace import Trace, Tracer
from tumble.messages import Message

FEWEST_POSITIONS = 5
"""With fewer positions than this the fourteen parameters are not determined by any choice of them."""


@dataclass(frozen=True, kw_only=True)
class TriadLoop:
    """The loop closed on a table of a triad."""

    observations: TriadObservations
    """Rows in use; those that are not stand in its `set_aside`."""
    doubts: tuple[str, ...]
    """Questions about the table; where there are any, nothing is stated."""
    before: TriadFit
    explained: Explained[TriadTable, TriadFit]
    declared: ModelFit
    augmented: ModelFit
    scalar: ScalarFit | None
    pure_errors: tuple[PureError, ...]
    """Scatter of a dwell mean of each channel between repeats."""
    declared_budget: Budget = field(default_factory=Budget)
    augmented_budget: Budget = field(default_factory=Budget)
    experiments: tuple[Experiment, ...] = ()
    """What to measure next, where that was asked; see `asked_next`."""

    @property
    def best(self) -> TriadFit:
        """The fit with what was found."""
        return self.explained.best

    @property
    def unit(self) -> str:
        """Of the outputs."""
        return "V"

    @property
    def held_out_rms(self) -> float | None:
        """Error of positions that are held out, with what was found, in volts."""
        return self.augmented.held_out_rms

    @property
    def explained_v(self) -> FloatArray:
        """What was found, in each dwell and channel, shape (dwells, 3), in volts."""
        shares = [
            item.form.columns @ self.best.coefficients[columns]
            for item, columns in zip(self.best.found, self.best.columns, strict=True)
        ]
        return np.asarray(sum(shares, self.best.drawn_v).reshape(-1, 3))

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """What was found, in the order of the evidence; nothing of a table in doubt."""
        if self.doubts:
            return ()
        found = effects_found(self.explained.table, self.explained.judged, self.best, self.explained.close)
        return tuple(sorted(found, key=lambda effect: effect.p_value))

    @property
    def withheld(self) -> tuple[Withheld, ...]:
        """What would fit the rows and is not stated."""
        return () if self.doubts else withheld(self.explained.table, self.explained.judged)

    @property
    def unexplained(self) -> Unexplained | None:
        """The largest structure that no effect of the catalogue explains; None where there is none."""
        return None if self.doubts else unexplained(self.explained.trace, self.explained.alike)


@dataclass(frozen=True, kw_only=True)
class TriadDeclared:
    """The declared model fitted to a table of a triad."""

    observations: TriadObservations
    """Rows in use."""
    table: TriadTable
    fit: TriadFit
    doubts: tuple[str, ...]
    """Questions about the table; where there are any, nothing is stated."""
    model: ModelFit
    budget: Budget = field(default_factory=Budget)


@one_blas_thread
def declared_fit(observations: TriadObservations, reference_temperature_degc: float = 23.0) -> TriadDeclared:
    """Fit fourteen parameters to a table. Raises `ValueError` where there are too few positions."""
    _check_positions(observations)
    return _declared(observations, gross_errors(observations), reference_temperature_degc)


def _declared(
    observations: TriadObservations, gross: Sequence[SetAside], reference_temperature_degc: float
) -> TriadDeclared:
    """The same without gross errors that are known."""
    used = observations.without(tuple(gross))
    table = triad_table(used, reference_temperature_degc)
    nothing = _nothing(table)
    fit = fit_triad(table, nothing)
    asked = doubts(table, fit.deviations_v)
    model = silent(asked[0]) if asked else modelled(fit, fit.parameters(), held_out_declared(table, nothing))
    return TriadDeclared(observations=used, table=table, fit=fit, doubts=asked, model=model)


def _check_positions(observations: TriadObservations) -> None:
    if (positions := len(np.unique(observations.positions))) < FEWEST_POSITIONS:
        raise ValueError(
            Message(
                "{source}: {positions} positions do not determine the fourteen parameters of a triad; at least "
                "{fewest} are needed",
                source=observations.source or "table",
                positions=positions,
                fewest=FEWEST_POSITIONS,
            )
        )


@one_blas_thread
def close_triad_loop(observations: TriadObservations, reference_temperature_degc: float = 23.0) -> TriadLoop:
    """Trace what fourteen parameters leave of a table. Raises `ValueError` where there are too few positions.

    What was found may explain dwells that were set aside as gross errors: then all is traced again with these.
    """
    before = declared_fit(observations, reference_temperature_degc)
    explained = _explained(before)
    gross = [each for each in before.observations.set_aside if each not in observations.set_aside]
    left = still_gross(observations, gross, explained) if gross and not before.doubts else gross
    if len(left) < len(gross):
        before = _declared(observations, left, reference_temperature_degc)
        explained = _explained(before)
    return _loop(before, explained)


def _explained(before: TriadDeclared) -> Explained[TriadTable, TriadFit]:
    """What a table was traced to; nothing where it is in doubt."""
    if before.doubts:
        return Explained(judged=_untraced(before.table), best=before.fit)
    found = judged(before.table)
    return Explained(judged=found, best=fit_triad(before.table, found.trace))


def _loop(before: TriadDeclared, explained: Explained[TriadTable, TriadFit]) -> TriadLoop:
    used, asked = before.observations, before.doubts
    return TriadLoop(
        observations=used,
        doubts=asked,
        before=before.fit,
        explained=explained,
        declared=before.model,
        augmented=silent(asked[0]) if asked else augmented(explained),
        scalar=None if asked else _scalar(used, explained.best, explained.trace.components),
        pure_errors=_pure_errors(used),
    )


def asked_next(loop: TriadLoop) -> TriadLoop:
    """The same with what to measure next, of all lists that come along."""
    return loop if loop.doubts else replace(loop, experiments=next_experiments(loop.explained))


def _nothing(table: TriadTable) -> Trace:
    """The declared model alone."""
    return Trace(found=(), noise=NoiseModel(), deviance=table.deviance((), NoiseModel()))


def _untraced(table: TriadTable) -> Judged[TriadTable]:
    """What a table in doubt is traced to: nothing is looked for where nothing would be stated."""
    return Judged(tracer=Tracer(table), trace=_nothing(table), near={}, scan=Scan(table.axes), evidence={}, withheld=())


def _scalar(observations: TriadObservations, best: TriadFit, components: Sequence[Component]) -> ScalarFit | None:
    """The scalar fit of the outputs less what was found in the unit and in the voltmeter."""
    shares = [
        item.form.columns @ best.coefficients[columns]
        for item, columns in zip(best.found, best.columns, strict=True)
        if item.effect.belongs_to != "stand"
    ]
    of_the_unit = not any(each.axis.channel.word == "angle" for each in components)
    drawn_v = best.drawn_v if of_the_unit else np.zeros(3 * len(observations))
    corrected = observations.outputs_v - sum(shares, drawn_v).reshape(-1, 3)
    return fit_scalar(corrected, 1.0 / channel_weights(observations))


def _pure_errors(observations: TriadObservations) -> tuple[PureError, ...]:
    even = np.ones(len(observations))
    return tuple(pure_error(output, observations.positions, even) for output in observations.outputs_v.T)
