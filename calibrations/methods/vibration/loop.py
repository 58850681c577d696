"""Closing the loop on vibrated dwells: what the declared model leaves, traced; coefficients before and after."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.repeats import PureError, pure_error
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.vibration.budget import Budget
from tumble.calibrations.methods.vibration.effects import OF_THE_LEVEL
from tumble.calibrations.methods.vibration.experiments import next_experiments
from tumble.calibrations.methods.vibration.fit import VibrationFit, fit_vibration, points_of
from tumble.calibrations.methods.vibration.gross import gross_errors
from tumble.calibrations.methods.vibration.models import augmented, declared_model
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.plausible import with_questions
from tumble.calibrations.methods.vibration.readmitted import still_gross, still_off
from tumble.calibrations.methods.vibration.table import (
    VibrationTable,
    points_beside,
    settings,
    vibration_table,
)
from tumble.calibrations.tracing.closed import ClosedLoop
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.findings import SHAPELESS_P
from tumble.calibrations.tracing.judged import Judged, judged
from tumble.calibrations.tracing.trace import nothing_found, penalised_deviance
from tumble.messages import Message

FEWEST_VIBRATED: Final = 2
_RELINEARISED: Final = 5
"""How often a table is traced at most, its nonlinear effects linearised each time where they were found."""
_LOST: Final = 9.0
"""Rise of -2 ln L from the secant of a nonlinear effect to the effect in full from which on it is none."""
_FORCED: Final = 8.0
"""By so much two names may be ahead of one course without a name in -2 ln L, penalties counted, and be forced on it."""
_MOVED: Final = 0.02
"""Relative change of a point from which on that is worth it."""


@dataclass(frozen=True, kw_only=True)
class VibrationDeclared:
    """The declared model fitted to vibrated dwells."""

    observations: VibrationObservations
    """Rows in use."""
    table: VibrationTable
    fit: VibrationFit
    model: ModelFit
    budget: Budget = field(default_factory=Budget)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Questions about the table: a table of dwells is refused or taken as it is."""
        return ()


@dataclass(frozen=True, kw_only=True)
class VibrationLoop(ClosedLoop[VibrationDeclared, VibrationTable, VibrationFit]):
    """The loop closed on vibrated dwells."""

    unit = "µg"

    pure_error: PureError
    """Scatter of a dwell mean between repeats of a setting."""
    augmented_budget: Budget = field(default_factory=Budget)

    @property
    def observations(self) -> VibrationObservations:
        """Rows in use; those that are not stand in its `set_aside`."""
        return self.declared_fit.observations


@one_blas_thread
def declared_fit(observations: VibrationObservations, reference_temperature_degc: float = 23.0) -> VibrationDeclared:
    """Fit the coefficients to vibrated dwells. Raises `ValueError`: too few, or an output that never changes."""
    _check(observations)
    whole = vibration_table(observations, observations, reference_temperature_degc)
    return _declared(observations, gross_errors(whole), reference_temperature_degc)


def _declared(
    observations: VibrationObservations, gross: Sequence[SetAside], reference_temperature_degc: float
) -> VibrationDeclared:
    used = observations.without(tuple(gross))
    table = vibration_table(used, observations, reference_temperature_degc)
    fit = fit_vibration(table, nothing_found(table))
    return VibrationDeclared(
        observations=with_questions(table), table=table, fit=fit, model=declared_model(table, fit, nothing_found(table))
    )


def _check(observations: VibrationObservations) -> None:
    vibrated = int(np.count_nonzero(observations.vibrated))
    if vibrated < FEWEST_VIBRATED or vibrated == len(observations):
        raise ValueError(
            Message.counted(
                "{source}: {vibrated} of {count} dwell is vibrated; rectification takes dwells at rest and at least "
                "{fewest} under vibration",
                "{source}: {vibrated} of {count} dwells are vibrated; rectification takes dwells at rest and at "
                "least {fewest} under vibration",
                source=observations.source or "table",
                vibrated=vibrated,
                count=len(observations),
                fewest=FEWEST_VIBRATED,
            )
        )
    numbers = observations.mountings
    if not any(np.ptp(observations.output_ug[numbers == number]) for number in np.unique(numbers)):
        raise ValueError(
            Message(
                "{source}: output_ug never changes between rest and vibration in a mounting; is the unit connected?",
                source=observations.source or "table",
            )
        )


@one_blas_thread
def close_vibration_loop(
    observations: VibrationObservations, reference_temperature_degc: float = 23.0
) -> VibrationLoop:
    """Trace what the five coefficients leave of a table. Raises `ValueError` as `declared_fit`.

    What was found may explain dwells that were set aside as gross errors: then all is traced again with these.
    """
    before = declared_fit(observations, reference_temperature_degc)
    explained = explained_rows(before.table)
    gross = [each for each in before.observations.set_aside if each not in observations.set_aside]
    if gross and (fewer := _fewer(observations, gross, explained, reference_temperature_degc)) is not None:
        before = _declared(observations, fewer, reference_temperature_degc)
        explained = explained_rows(before.table)
    setting = settings(before.table.scene)
    model, lines = augmented(explained)
    return VibrationLoop(
        declared_fit=before,
        explained=explained,
        augmented=model,
        augmented_budget=Budget(lines=lines),
        pure_error=pure_error(before.observations.output_ug, setting, before.table.weights),
    )


def _fewer(
    observations: VibrationObservations,
    gross: Sequence[SetAside],
    explained: Explained[VibrationTable, VibrationFit],
    reference_temperature_degc: float,
) -> tuple[SetAside, ...] | None:
    """The gross errors that are left by what was found without them, or with all of them; None where all are left.

    What was found without them may explain them; or they are what shows an effect in the first place.
    """
    left = still_gross(observations, gross, explained)
    if len(left) == len(gross) > 1:
        everything = explained_rows(vibration_table(observations, observations, reference_temperature_degc))
        left = still_off(gross, everything)
    return left if len(left) < len(gross) else None


def asked_next(loop: VibrationLoop) -> VibrationLoop:
    """The same with what to measure next, of all programmes that come along."""
    return replace(loop, experiments=next_experiments(loop.explained))


def explained_rows(table: VibrationTable) -> Explained[VibrationTable, VibrationFit]:
    """What a table is traced to; structure without a name where several names would stand for one course of the level.

    Of a few levels of one drive any two effects that follow the level alone make up almost any course of it: where one
    without a name explains about as much, the names are forced upon it, even where one of them fell already. And where
    effects fell that stood for something, it is looked for once more without them.
    """
    named = _explained(table)
    fallen = tuple(each.name for each in named.judged.withheld if not each.unnamed)
    forced = {*map(str, named.trace.names), *fallen}.intersection(OF_THE_LEVEL)
    if len(forced) < 2 and not (fallen and _differs(named)):
        return named
    unnamed = _explained(table.without(*(OF_THE_LEVEL if len(forced) > 1 else fallen)))
    if len(forced) < 2:
        return unnamed if unnamed.trace.components else named
    courses = [each for each in unnamed.trace.components if each.depends_on == "amplitude"]
    near = penalised_deviance(unnamed.trace) < penalised_deviance(named.trace) + _FORCED
    return unnamed if courses and near else named


def _differs(named: Explained[VibrationTable, VibrationFit]) -> bool:
    """Whether settings differ in no shape beyond everything that was found: what fell stood for something."""
    return not named.trace.components and named.judged.lack.alike < SHAPELESS_P


def _explained(table: VibrationTable) -> Explained[VibrationTable, VibrationFit]:
    """What a table is traced to, nonlinear effects linearised where they came to lie beside everything else.

    One that only its secant with a size of its own explains, and not the effect in full, is not looked for any more.
    """
    for _ in range(_RELINEARISED):
        found = judged(table)
        fit = fit_vibration(found.tracer.table, found.trace)
        moved = _relinearised(table, found, fit)
        if moved is not None:
            table = moved
        elif name := _contradicted(found, fit):
            table = table.without(name)
        else:
            break
    return Explained(judged=found, best=fit)


def _contradicted(found: Judged[VibrationTable], fit: VibrationFit) -> str:
    """The nonlinear effect that in full explains the rows worse than its secant does; empty where none does."""
    linear = found.tracer.table.fit(found.trace.forms, found.trace.noise)
    own = {name: point.value for name, point in points_of(fit).items()}
    lost = found.tracer.table.rows * float(np.log(fit.squares / linear.squares))
    if not own or lost < _LOST:
        return ""
    by_secant = {
        str(item.effect.name): float(linear.theta[linear.parameters :][place.start])
        for item, place in zip(fit.found, fit.columns, strict=True)
    }
    return max(own, key=lambda name: abs(by_secant[name] / own[name] - 1.0))


def _relinearised(table: VibrationTable, found: Judged[VibrationTable], fit: VibrationFit) -> VibrationTable | None:
    """The table linearised anew; None where nothing moved that matters."""
    if not found.trace.found:
        return None
    columns = [item.form.columns for item in found.trace.found]
    points = {**points_beside(table, columns), **points_of(fit)}
    names = {*points_of(fit), *(rival.name for near in found.near.values() for rival in near)}
    old = table.scene.points
    far = [
        name
        for name, point in points.items()
        if name not in old or (name in names and abs(point.value - old[name].value) > _MOVED * abs(point.value))
    ]
    return table.at(points) if far else None
