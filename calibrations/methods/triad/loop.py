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
from tumble.calibrations.methods.triad.readmitted import MORE_THAN_A_FEW, still_gross, still_off
from tumble.calibrations.methods.triad.scalar import ScalarFit, fit_scalar
from tumble.calibrations.methods.triad.table import TriadTable, triad_table
from tumble.calibrations.methods.triad.weights import channel_weights
from tumble.calibrations.tracing.closed import ClosedLoop
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.judged import judged, untraced
from tumble.calibrations.tracing.trace import nothing_found
from tumble.messages import Message

FEWEST_POSITIONS = 5
"""With fewer positions than this the fourteen parameters are not determined by any choice of them."""


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


@dataclass(frozen=True, kw_only=True)
class TriadLoop(ClosedLoop[TriadDeclared, TriadTable, TriadFit]):
    """The loop closed on a table of a triad."""

    unit = "V"

    scalar: ScalarFit | None
    pure_errors: tuple[PureError, ...]
    """Scatter of a dwell mean of each channel between repeats."""
    augmented_budget: Budget = field(default_factory=Budget)

    @property
    def observations(self) -> TriadObservations:
        """Rows in use; those that are not stand in its `set_aside`."""
        return self.declared_fit.observations

    @property
    def before(self) -> TriadFit:
        """The fit without what was found."""
        return self.declared_fit.fit

    @property
    def explained_v(self) -> FloatArray:
        """What was found, in each dwell and channel, shape (dwells, 3), in volts."""
        shares = [
            item.form.columns @ self.best.coefficients[columns]
            for item, columns in zip(self.best.found, self.best.columns, strict=True)
        ]
        return np.asarray(sum(shares, self.best.drawn_v).reshape(-1, 3))


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
    nothing = nothing_found(table)
    fit = fit_triad(table, nothing)
    asked = doubts(table, fit.deviations_v)
    model = silent(asked[0]) if asked else modelled(fit, fit.parameters(), held_out_declared(table, nothing))
    return TriadDeclared(observations=used, table=table, fit=fit, doubts=asked, model=model)


def _check_positions(observations: TriadObservations) -> None:
    if (positions := len(np.unique(observations.positions))) < FEWEST_POSITIONS:
        raise ValueError(
            Message.counted(
                "{source}: {count} position does not determine the fourteen parameters of a triad; at least "
                "{fewest} are needed",
                "{source}: {count} positions do not determine the fourteen parameters of a triad; at least {fewest} "
                "are needed",
                source=observations.source or "table",
                count=positions,
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
    left = gross if before.doubts else _left(observations, gross, explained, reference_temperature_degc)
    if len(left) < len(gross):
        before = _declared(observations, left, reference_temperature_degc)
        explained = _explained(before)
    return _loop(before, explained)


def _left(
    observations: TriadObservations,
    gross: Sequence[SetAside],
    explained: Explained[TriadTable, TriadFit],
    reference_temperature_degc: float,
) -> Sequence[SetAside]:
    """The gross errors that are left by what was found without them or, where they are many, with all of them."""
    left = still_gross(observations, gross, explained) if gross else gross
    if len(left) < len(gross) or len(gross) < MORE_THAN_A_FEW:
        return left
    return still_off(gross, _explained(_declared(observations, (), reference_temperature_degc)))


def _explained(before: TriadDeclared) -> Explained[TriadTable, TriadFit]:
    """What a table was traced to; nothing where it is in doubt."""
    if before.doubts:
        return Explained(judged=untraced(before.table), best=before.fit)
    found = judged(before.table)
    return Explained(judged=found, best=fit_triad(before.table, found.trace))


def _loop(before: TriadDeclared, explained: Explained[TriadTable, TriadFit]) -> TriadLoop:
    used, asked = before.observations, before.doubts
    model, lines = (silent(asked[0]), ()) if asked else augmented(explained)
    return TriadLoop(
        declared_fit=before,
        explained=explained,
        augmented=model,
        augmented_budget=Budget(lines=lines),
        scalar=None if asked else _scalar(used, explained.best, explained.trace.components),
        pure_errors=_pure_errors(used),
    )


def asked_next(loop: TriadLoop) -> TriadLoop:
    """The same with what to measure next, of all lists that come along."""
    return loop if loop.doubts else replace(loop, experiments=next_experiments(loop.explained))


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
