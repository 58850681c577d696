"""Closing the loop on a gyrocompass: what heading and drift leave, traced; both before and after."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.repeats import PureError, pure_error
from tumble.calibrations.methods.gyrocompass.anew import seen_anew
from tumble.calibrations.methods.gyrocompass.assessed import Budget
from tumble.calibrations.methods.gyrocompass.azimuth_channel import AzimuthDrift, azimuth_drift
from tumble.calibrations.methods.gyrocompass.azimuth_mark import MarkCheck, mark_check
from tumble.calibrations.methods.gyrocompass.baseline import Baseline, baseline_of
from tumble.calibrations.methods.gyrocompass.closure import Closure, closure_of
from tumble.calibrations.methods.gyrocompass.declared_noise import InDeclaredNoise, in_declared_noise
from tumble.calibrations.methods.gyrocompass.doubts import doubts
from tumble.calibrations.methods.gyrocompass.experiments import next_experiments
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit, fit_gyrocompass
from tumble.calibrations.methods.gyrocompass.gross import gross_errors, left_gross
from tumble.calibrations.methods.gyrocompass.headings import possible_headings_deg
from tumble.calibrations.methods.gyrocompass.misreading import Misreading, as_effect, misreadings
from tumble.calibrations.methods.gyrocompass.models import augmented, held_out_declared, modelled, silent, with_headings
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.readmitted import still_gross
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable, gyrocompass_table
from tumble.calibrations.tracing.closed import ClosedLoop
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.judged import judged, untraced
from tumble.calibrations.tracing.trace import nothing_found
from tumble.messages import Message

FEWEST_POSITIONS: Final = 2
"""One position tells neither heading nor drift."""
_ROUNDS: Final = 3
"""So often a table is traced anew from where it was found to be."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassDeclared:
    """Heading and drift fitted to a table."""

    observations: GyrocompassObservations
    """Rows in use."""
    table: GyrocompassTable
    fit: GyrocompassFit
    headings_deg: tuple[float, ...]
    """Every α0 that the rates allow, the best first."""
    doubts: tuple[str, ...]
    """Questions about the table; where there are any, nothing is stated."""
    model: ModelFit
    budget: Budget = field(default_factory=Budget)


@dataclass(frozen=True, kw_only=True)
class GyrocompassLoop(ClosedLoop[GyrocompassDeclared, GyrocompassTable, GyrocompassFit]):
    """The loop closed on a table of a gyrocompass."""

    unit = "deg_h"

    misread: tuple[Misreading, ...]
    pure_error: PureError
    """Scatter of a mean rate between repeats of a position."""
    augmented_budget: Budget = field(default_factory=Budget)

    @property
    def observations(self) -> GyrocompassObservations:
        """Rows in use; those that are not stand in its `set_aside`."""
        return self.declared_fit.observations

    @property
    def before(self) -> GyrocompassFit:
        """The fit without what was found."""
        return self.declared_fit.fit

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """What was found, misread angles among it, in the order of the evidence; nothing of a table in doubt."""
        found = (*super().effects, *as_effect(self.misread))
        return () if self.doubts else tuple(sorted(found, key=lambda effect: effect.p_value))

    @property
    def not_traced(self) -> str:
        """Why nothing was looked for; empty where it was."""
        if len(self.declared_fit.headings_deg) > 1:
            return Message("several headings are possible")
        return self.explained.table.not_traced

    @cached_property
    def closure(self) -> Closure | None:
        """Whether the earth rate has the size that the latitude says; None where that is not told."""
        if self.doubts or len(self.declared_fit.headings_deg) > 1:
            return None
        return closure_of(self.explained.table, self.explained.trace, self.best)

    @cached_property
    def baseline(self) -> Baseline | None:
        """The published formula on three of the positions; None where there are fewer."""
        return None if self.doubts else baseline_of(self.observations)

    @cached_property
    def azimuth_drift(self) -> AzimuthDrift | None:
        """Drift of the azimuth channel; None where the table has no rate of it."""
        return None if self.doubts else azimuth_drift(self.explained.table, self.best)

    @cached_property
    def mark(self) -> MarkCheck | None:
        """The heading against an azimuth mark; None where the table has none."""
        return None if self.doubts else mark_check(self.explained.table, self.best)

    @cached_property
    def in_declared_noise(self) -> InDeclaredNoise | None:
        """Heading and drift if the gyro is as the table declares it; None where it declares nothing."""
        if self.doubts:
            return None
        return in_declared_noise(self.explained.table, self.best, self.augmented.parameters)

    @property
    def drawn_deg_h(self) -> FloatArray:
        """What was found in the rates, shape (dwells,)."""
        shares = [
            item.form.columns @ self.best.coefficients[columns]
            for item, columns in zip(self.best.found, self.best.columns, strict=True)
        ]
        return np.asarray(sum(shares, self.best.drawn)[self.explained.table.rates])


@one_blas_thread
def declared_fit(
    observations: GyrocompassObservations, reference_temperature_degc: float = 23.0
) -> GyrocompassDeclared:
    """Fit heading and drift to a table. Raises `ValueError` where there is one position only."""
    _check_positions(observations)
    used = observations.without(gross_errors(observations))
    return _declared(used, gyrocompass_table(used, reference_temperature_degc))


def _declared(used: GyrocompassObservations, table: GyrocompassTable) -> GyrocompassDeclared:
    nothing = nothing_found(table)
    fit = fit_gyrocompass(table, nothing)
    asked = doubts(table, fit)
    headings_deg = possible_headings_deg(table, fit.dwell)
    stated = with_headings(fit.parameters(), headings_deg)
    model = silent(asked[0]) if asked else modelled(table, fit, stated, held_out_declared(table, nothing))
    return GyrocompassDeclared(
        observations=used, table=table, fit=fit, headings_deg=headings_deg, doubts=asked, model=model
    )


def _check_positions(observations: GyrocompassObservations) -> None:
    if len(np.unique(observations.positions)) < FEWEST_POSITIONS:
        raise ValueError(
            Message(
                "{source}: one position tells neither heading nor drift; turn the platform to two others at least",
                source=observations.source or "table",
            )
        )


@one_blas_thread
def close_gyrocompass_loop(
    observations: GyrocompassObservations, reference_temperature_degc: float = 23.0
) -> GyrocompassLoop:
    """Trace what heading and drift leave of a table. Raises `ValueError` where there is one position only.

    What was found may explain dwells that were set aside as gross errors: then all is traced again with these, as it is
    without others that an effect had hidden.
    """
    before = declared_fit(observations, reference_temperature_degc)
    before, explained = _closed(before)
    gross = [each for each in before.observations.set_aside if each not in observations.set_aside]
    left = still_gross(observations, explained)
    further = left_gross(before.observations, _left(explained)) if explained.trace.names else ()
    if len(left) < len(gross) or further:
        used = observations.without((*left, *further))
        before, explained = _closed(_declared(used, gyrocompass_table(used, reference_temperature_degc)))
    return _loop(observations, before, explained)


def _left(explained: Explained[GyrocompassTable, GyrocompassFit]) -> FloatArray:
    """What is left of each dwell's rows, weighted, shape (dwells, outputs)."""
    table = explained.table
    return np.asarray((explained.best.residual * np.sqrt(table.weights)).reshape(table.scene.dwells, -1))


def _closed(
    before: GyrocompassDeclared,
) -> tuple[GyrocompassDeclared, Explained[GyrocompassTable, GyrocompassFit]]:
    """A table traced, and traced anew from where it was found to be as often as that makes a difference."""
    explained = _explained(before)
    for _ in range(_ROUNDS):
        table = seen_anew(explained)
        if table is None or before.doubts:
            break
        before = _declared(before.observations, table)
        explained = _explained(before)
    return before, explained


def _explained(before: GyrocompassDeclared) -> Explained[GyrocompassTable, GyrocompassFit]:
    """What a table was traced to; nothing where it is in doubt, or where several headings are possible."""
    if before.doubts or len(before.headings_deg) > 1:
        return Explained(judged=untraced(before.table), best=before.fit)
    found = judged(before.table)
    return Explained(judged=found, best=fit_gyrocompass(before.table, found.trace))


def _loop(
    whole: GyrocompassObservations,
    before: GyrocompassDeclared,
    explained: Explained[GyrocompassTable, GyrocompassFit],
) -> GyrocompassLoop:
    used = before.observations
    model, lines = before.model, tuple[BudgetLine, ...]()
    if not before.doubts and len(before.headings_deg) < FEWEST_POSITIONS:
        model, lines = augmented(explained)
    return GyrocompassLoop(
        declared_fit=before,
        explained=explained,
        augmented=model,
        augmented_budget=Budget(lines=lines),
        misread=() if before.doubts else misreadings(whole, explained.table, explained.best),
        pure_error=pure_error(used.rate_deg_h, used.positions, np.ones(len(used))),
    )


def asked_next(loop: GyrocompassLoop) -> GyrocompassLoop:
    """The same with what to measure next."""
    if loop.doubts:
        return loop
    return replace(loop, experiments=next_experiments(loop.explained, loop.declared_fit.headings_deg))
