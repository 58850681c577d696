"""Closing the loop: what is left, to what it is traced, and what that does to parameters and error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from scipy.special import chdtrc

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.gross import GROSS_SIGMA
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.analysis import assess
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.gross import unlike_repeats
from tumble.calibrations.methods.dividing_head.joint import Joint, fit_jointly, fit_without
from tumble.calibrations.methods.dividing_head.loop.at_rest import at_rest
from tumble.calibrations.methods.dividing_head.loop.augmented import Augmented, augment
from tumble.calibrations.methods.dividing_head.loop.averaged import averaged
from tumble.calibrations.methods.dividing_head.loop.head_error import alpha0_reach
from tumble.calibrations.methods.dividing_head.loop.hidden import resting_on_absence
from tumble.calibrations.methods.dividing_head.loop.misreading import MISREADING, Misreading, misreadings
from tumble.calibrations.methods.dividing_head.loop.more_settings import more_settings
from tumble.calibrations.methods.dividing_head.loop.predicting import with_held_out
from tumble.calibrations.methods.dividing_head.loop.reach import Reach, reach
from tumble.calibrations.methods.dividing_head.loop.scatter import scatter_and_wandering
from tumble.calibrations.methods.dividing_head.loop.settling import settling
from tumble.calibrations.methods.dividing_head.loop.still import ONE_POSE, Still, in_one_pose, stillness
from tumble.calibrations.methods.dividing_head.loop.table import (
    DividingHeadTable,
    dividing_head_table,
    relinearised,
    scene_of,
)
from tumble.calibrations.methods.dividing_head.loop.unexplained import unexplained
from tumble.calibrations.methods.dividing_head.loop.withholding import without_alike, without_rivals
from tumble.calibrations.methods.dividing_head.model import ALPHA0
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import pose_groups
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.methods.dividing_head.questions import Questioned, questioned
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.weights import weights_of_all
from tumble.calibrations.tracing import explained as tracing
from tumble.calibrations.tracing.effect import Effect
from tumble.calibrations.tracing.experiments import Experiment, locating_experiments, next_experiments
from tumble.calibrations.tracing.findings import EffectFound, Unexplained, Withheld, effects_found, withheld
from tumble.calibrations.tracing.fitting_noise import with_likely_flicker
from tumble.calibrations.tracing.judged import judged
from tumble.calibrations.tracing.neighbours import every_near
from tumble.calibrations.tracing.rivals import Rival
from tumble.calibrations.tracing.trace import penalised_deviance
from tumble.messages import Message

Explained: TypeAlias = tracing.Explained[DividingHeadTable, Augmented]
"""A table without gross errors, what it was traced to, and what could stand in its place."""


@dataclass(frozen=True, kw_only=True)
class Loop:
    """The loop closed on one table."""

    declared: Calibration
    augmented: Calibration
    effects: tuple[EffectFound, ...]
    """In the order of the evidence."""
    unexplained: Unexplained | None
    misread: tuple[Misreading, ...]
    next_experiment: tuple[Experiment, ...] = ()
    """What would distinguish the rivals that are left."""
    not_traced: str = ""
    """Why nothing was looked for; empty where the table was traced."""
    withheld: tuple[Withheld, ...] = ()
    """What would fit the rows, but is not stated."""
    reach: Reach | None = None
    """What the settings can show at all; None where nothing was traced."""
    still: Still | None = None
    """What the output follows in a table of one pose; None for any other."""
    unit: str = "V"
    """Of the output."""

    @property
    def held_out_rms(self) -> float | None:
        """Error of rows that are held out with what was found, in volts."""
        return self.augmented.held_out_rms_v


def close_loop(
    observations: Observations,
    stand: StandUncertainty | None = None,
    reference_temperature_degc: float = 23.0,
    effects: Sequence[Effect[Scene]] = CATALOGUE,
) -> Loop:
    """Fit the declared model, trace what it leaves, add what was found, say what that changes and what to measure next.

    A table that contradicts its own description is asked about instead: the questions are among its warnings.

    Raises
    ------
    ValueError
        No voltage, or no usable row.
    """
    return asked_next(*explain(observations, stand, reference_temperature_degc, effects))


@one_blas_thread
def asked_next(loop: Loop, explained: Explained | None) -> Loop:
    """What `explain` gives, with what to measure next."""
    if explained is None:
        return loop
    separating = (
        *next_experiments(explained.table, explained.trace, explained.close, PROBES),
        *locating_experiments(explained.table, explained.trace, explained.alike, PROBES),
    )
    wanted = (*separating, *more_settings(loop.withheld, loop.unexplained, _reach(explained)))
    told = any(experiment.command for experiment in wanted)
    return replace(loop, next_experiment=wanted if told else (*wanted, *settling(loop.augmented)))


def explain(
    observations: Observations,
    stand: StandUncertainty | None = None,
    reference_temperature_degc: float = 23.0,
    effects: Sequence[Effect[Scene]] = CATALOGUE,
) -> tuple[Loop, Explained | None]:
    """`close_loop` before it is asked what to measure next; with it what that rests on, None where nothing was traced.

    Raises
    ------
    ValueError
        No voltage, or no usable row.
    """
    asked = questioned(observations, reference_temperature_degc)
    return explain_questioned(asked, stand, reference_temperature_degc, effects)


@one_blas_thread
def explain_questioned(
    asked: Questioned,
    stand: StandUncertainty | None = None,
    reference_temperature_degc: float = 23.0,
    effects: Sequence[Effect[Scene]] = CATALOGUE,
) -> tuple[Loop, Explained | None]:
    """`explain` for a table about which it is known what there is to ask. Raises as that does."""
    uncertainty, observations = stand or StandUncertainty(), asked.observations
    declared = fit_jointly(observations)
    if why := _obstacle(asked):
        return _untraced(asked, assess(declared, uncertainty, trials=0), why), None
    explained = _explained(declared, effects, reference_temperature_degc)
    for _ in range(_ROUNDS):
        rejected = _gross_errors(observations, explained)
        if {entry.row for entry in rejected} == _rejected_rows(explained.table.joint):
            break
        explained = _explained(fit_without(observations, rejected), effects, reference_temperature_degc)
    trace, close, best = explained.trace, explained.close, explained.best
    misread = misreadings(observations, best.joint)
    before = assess(explained.table.joint, uncertainty, trials=0)  # of the same rows as what is stated
    stated = assess(best.joint, uncertainty, trials=0, further=best.shapes)
    stated = with_held_out(stated, before, explained.tracer, trace, explained.table)
    whole, others = explained.table.with_components(trace.components), explained.alike
    augmented = without_alike(without_rivals(stated, whole, close), whole, trace, others)
    augmented = resting_on_absence(augmented, set(trace.names))
    rivals = every_near(explained.tracer, trace, explained.near, (*others, *explained.judged.nearly))
    courses = best.courses(whole, trace)
    resting, reaches = at_rest(best.joint.fit.theta, courses), alpha0_reach(best, courses)
    augmented = averaged(augmented, explained.table, rivals, resting, reaches)
    said = scatter_and_wandering(explained.table, trace, best.joint)
    augmented = replace(augmented, warnings=(*augmented.warnings, *said))
    loop = Loop(
        declared=resting_on_absence(before, set(trace.names)),
        augmented=augmented,
        effects=_effects(explained, close, misread),
        unexplained=unexplained(explained.judged, _reach(explained), others, courses),
        misread=misread,
        not_traced=explained.table.not_traced,
        withheld=withheld(explained.table, explained.judged),
        reach=_reach(explained),
    )
    return loop, explained


def _obstacle(asked: Questioned) -> str:
    """Why a table is not traced; empty where it is."""
    if not asked.answerable:
        return Message("the table contradicts its own description; answer the question first")
    if (rows := len(asked.observations)) > MOST_TRACED:
        return Message(
            "its {rows:,} rows are more than the {most:,} that are traced at once; give means or a part of them",
            rows=rows,
            most=MOST_TRACED,
        )
    return ONE_POSE if in_one_pose(asked.observations) else ""


def _untraced(asked: Questioned, calibration: Calibration, why: str) -> Loop:
    """The declared model alone, with a warning that says why; a question is a warning already."""
    warning = Message("{source}: nothing was traced: {why}", source=calibration.observations.source, why=why)
    warned = replace(calibration, warnings=(*calibration.warnings, *[warning] * asked.answerable))
    return Loop(
        declared=warned,
        augmented=warned,
        effects=(),
        unexplained=None,
        misread=(),
        not_traced=why,
        still=stillness(calibration.observations),
    )


MOST_TRACED = 30_000
"""Rows. Tracing holds thousands of numbers of each: so many take 2 to 3 GB, and a minute or two."""
_ROUNDS = 3
"""How often a table is relinearised once effects are known."""
_MOVED_DEG = 0.02
"""A change of alpha0 that changes what effects look like."""
_FAR_DEG = 10.0
"""An alpha0 beyond this is not believed."""


def _reach(explained: Explained) -> Reach:
    """What the settings can show."""
    return reach(explained.table.observations, explained.judged.lack, explained.table.unit)


def _explained(joint: Joint, effects: Sequence[Effect[Scene]], reference_temperature_degc: float) -> Explained:
    """Trace a table; again, where what was found shows that it was linearised at a wrong alpha0."""
    table = dividing_head_table(joint, effects, reference_temperature_degc)
    explanations: list[Explained] = []
    for _ in range(_ROUNDS):
        found = judged(table)
        trace = found.trace
        whole = table.with_components(trace.components)
        best = augment(whole, replace(trace, noise=with_likely_flicker(whole, trace.forms, trace.noise)))
        explanations.append(Explained(judged=found, best=best))
        alpha0_deg = float(best.joint.fit.theta[ALPHA0])
        moved_deg = abs(alpha0_deg - table.scene.alpha0_deg)
        if not trace.found or moved_deg < _MOVED_DEG or abs(alpha0_deg) > _FAR_DEG:
            break
        table = relinearised(table, best.joint.fit.theta)
    return min(explanations, key=lambda each: penalised_deviance(each.trace))


def _rejected_rows(joint: Joint) -> set[int]:
    return {entry.row for entry in joint.observations.set_aside if entry.gross}


def _gross_errors(observations: Observations, explained: Explained) -> tuple[SetAside, ...]:
    """Gross errors of the whole table as the augmented model sees them: an effect may have looked like one.

    So may a level or a walk: what is known of it is taken off the rows that were fitted.
    """
    joint = explained.best.joint
    scene = scene_of(observations, joint.fit.theta)
    residual = explained.best.residual_v(scene)
    residual[np.isin(observations.row, joint.observations.row)] = joint.residual_v
    spare = len(joint.observations) - joint.fit.fitted
    residual *= np.sqrt(weights_of_all(observations, joint.observations, joint.weights))
    return unlike_repeats(observations, residual, pose_groups(observations), joint.noise.used_v, spare)


def _effects(
    explained: Explained, close: Mapping[str, Sequence[Rival]], misread: Sequence[Misreading]
) -> tuple[EffectFound, ...]:
    found = effects_found(explained.table, explained.judged, explained.best, close)
    if misread:
        found.append(_misreading())
    return tuple(sorted(found, key=lambda effect: effect.p_value))


def _misreading() -> EffectFound:
    """Misread rows; the chance is that of one good row so far off, which bounds theirs from above."""
    return EffectFound(
        name=MISREADING,
        also_possible=(),
        belongs_to="stand",
        coefficients={},
        p_value=float(chdtrc(1, GROSS_SIGMA**2)),
    )
