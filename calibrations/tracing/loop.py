"""Closing the loop: what is left, to what it is traced, and what that does to parameters and error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtrc

from tumble.calibrations.adequacy import held_out_parts
from tumble.calibrations.analysis import assess
from tumble.calibrations.blas_threads import one_blas_thread
from tumble.calibrations.budget import StandUncertainty
from tumble.calibrations.effects import CATALOGUE
from tumble.calibrations.effects.effect import Effect
from tumble.calibrations.effects.scene import Scene
from tumble.calibrations.gross import GROSS_SIGMA, unlike_repeats
from tumble.calibrations.joint import Joint, fit_jointly, fit_without
from tumble.calibrations.model import ALPHA0
from tumble.calibrations.observations import Observations, SetAside
from tumble.calibrations.repeats import pose_groups
from tumble.calibrations.result import Calibration
from tumble.calibrations.tracing.augmented import Augmented, augment
from tumble.calibrations.tracing.experiments import Experiment, next_experiments
from tumble.calibrations.tracing.findings import (
    EffectFound,
    Unexplained,
    Withheld,
    effects_found,
    unexplained,
    withheld,
)
from tumble.calibrations.tracing.fitting_noise import with_likely_flicker
from tumble.calibrations.tracing.ground import Ground, ground, scene_of, seen_anew
from tumble.calibrations.tracing.held_out import held_out_rms
from tumble.calibrations.tracing.judged import Judged, judged
from tumble.calibrations.tracing.misreading import Misreading, misreadings
from tumble.calibrations.tracing.more_settings import more_settings
from tumble.calibrations.tracing.questions import Questioned, questioned
from tumble.calibrations.tracing.reach import Reach, reach
from tumble.calibrations.tracing.rivals import CLOSE, Rival
from tumble.calibrations.tracing.still import ONE_POSE, Still, in_one_pose, stillness
from tumble.calibrations.tracing.taken_back import without_courses, without_rivals
from tumble.calibrations.tracing.trace import Trace, Tracer, trace_price


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
    """What would part the rivals that are left."""
    not_traced: str = ""
    """Why nothing was looked for; empty where the table was traced."""
    withheld: tuple[Withheld, ...] = ()
    """What would fit the rows, but is not stated."""
    reach: Reach | None = None
    """What the settings can show at all; None where nothing was traced."""
    still: Still | None = None
    """What the output follows in a table of one pose; None for any other."""


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
def asked_next(loop: Loop, explained: "Explained | None") -> Loop:
    """What `explain` gives, with what to measure next."""
    if explained is None:
        return loop
    parting = next_experiments(explained.base, explained.trace, explained.close)
    return replace(loop, next_experiment=(*parting, *more_settings(loop.withheld, loop.unexplained, explained.reach)))


@one_blas_thread
def explain(
    observations: Observations,
    stand: StandUncertainty | None = None,
    reference_temperature_degc: float = 23.0,
    effects: Sequence[Effect[Scene]] = CATALOGUE,
) -> tuple[Loop, "Explained | None"]:
    """`close_loop` before it is asked what to measure next; with it what that rests on, None where nothing was traced.

    Raises
    ------
    ValueError
        No voltage, or no usable row.
    """
    uncertainty = stand or StandUncertainty()
    asked = questioned(observations, reference_temperature_degc)
    observations = asked.observations
    declared = fit_jointly(observations)
    if why := _obstacle(asked):
        return _untraced(asked, assess(declared, uncertainty, trials=0), why), None
    explained = _explained(declared, effects, reference_temperature_degc)
    for _ in range(_ROUNDS):
        rejected = _gross_errors(observations, explained)
        if {entry.row for entry in rejected} == _rejected_rows(explained.base.joint):
            break
        explained = _explained(fit_without(observations, rejected), effects, reference_temperature_degc)
    trace, close, best = explained.trace, explained.close, explained.best
    misread = misreadings(observations, best.joint)
    stated = without_courses(assess(best.joint, uncertainty, trials=0), best)
    if trace.found or trace.names:
        stated = replace(
            stated,
            held_out_rms_v=held_out_rms(explained.tracer, trace, held_out_parts(explained.base.joint.observations)),
        )
    augmented = without_rivals(stated, explained.base, explained.near)
    loop = Loop(
        declared=assess(declared, uncertainty, trials=0),
        augmented=augmented,
        effects=_effects(explained, close, misread),
        unexplained=unexplained(explained.judged, explained.reach),
        misread=misread,
        not_traced=explained.base.not_traced,
        withheld=withheld(explained.base, explained.judged),
        reach=explained.reach,
    )
    return loop, explained


def _obstacle(asked: Questioned) -> str:
    """Why a table is not traced; empty where it is."""
    if not asked.answerable:
        return "the table contradicts its own description; answer the question first"
    if (rows := len(asked.observations)) > MOST_TRACED:
        return (
            f"its {rows:,} rows are more than the {MOST_TRACED:,} that are traced at once; give means or a part of them"
        )
    return ONE_POSE if in_one_pose(asked.observations) else ""


def _untraced(asked: Questioned, calibration: Calibration, why: str) -> Loop:
    """The declared model alone, with a warning that says why; a question is a warning already."""
    said = (f"{calibration.observations.source}: nothing was traced: {why}",) if asked.answerable else ()
    told = replace(calibration, warnings=(*calibration.warnings, *said))
    return Loop(
        declared=told,
        augmented=told,
        effects=(),
        unexplained=None,
        misread=(),
        not_traced=why,
        still=stillness(calibration.observations),
    )


MOST_TRACED = 30_000
"""Rows. Tracing holds thousands of numbers of each: so many take 2 to 3 GB, and a minute or two."""
_ROUNDS = 3
"""How often a table is looked at anew once effects are known."""
_MOVED_DEG = 0.02
"""A change of alpha0 that changes what effects look like."""
_FAR_DEG = 10.0
"""An alpha0 beyond this is not believed."""


@dataclass(frozen=True, kw_only=True)
class Explained:
    """A table without gross errors, what it was traced to, and what could stand in its place."""

    judged: Judged[Ground]
    best: Augmented

    @property
    def tracer(self) -> Tracer[Ground]:
        """The table with everything that it may be traced to."""
        return self.judged.tracer

    @property
    def trace(self) -> Trace:
        """What it was traced to."""
        return self.judged.trace

    @property
    def near(self) -> Mapping[str, Sequence[Rival]]:
        """Near rivals of each effect of the trace."""
        return self.judged.near

    @property
    def base(self) -> Ground:
        """The table."""
        return self.tracer.ground

    @property
    def reach(self) -> Reach:
        """What the settings can show."""
        return reach(self.base.observations, self.judged.lack, self.base.unit)

    @property
    def close(self) -> dict[str, list[Rival]]:
        """Rivals of each effect that cannot be told from it."""
        return {name: [rival for rival in near if rival.behind < CLOSE] for name, near in self.near.items()}


def _explained(joint: Joint, effects: Sequence[Effect[Scene]], reference_temperature_degc: float) -> Explained:
    """Trace a table; again, where what was found shows that it was looked at from a wrong alpha0."""
    base = ground(joint, effects, reference_temperature_degc)
    looks: list[Explained] = []
    for _ in range(_ROUNDS):
        found = judged(base)
        trace = found.trace
        best = augment(base, replace(trace, noise=with_likely_flicker(base, trace.forms, trace.noise)))
        looks.append(Explained(judged=found, best=best))
        alpha0_deg = float(best.joint.fit.theta[ALPHA0])
        moved_deg = abs(alpha0_deg - base.scene.alpha0_deg)
        if not trace.found or moved_deg < _MOVED_DEG or abs(alpha0_deg) > _FAR_DEG:
            break
        base = seen_anew(base, best.joint.fit.theta)
    return min(looks, key=lambda look: trace_price(look.trace))


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
    return unlike_repeats(observations, residual, pose_groups(observations), joint.noise.used_v, spare)


def _effects(
    explained: Explained, close: Mapping[str, Sequence[Rival]], misread: Sequence[Misreading]
) -> tuple[EffectFound, ...]:
    found = effects_found(explained.base, explained.judged, explained.best, close)
    if misread:
        found.append(_misreading())
    return tuple(sorted(found, key=lambda effect: effect.p_value))


def _misreading() -> EffectFound:
    """Misread rows; the chance is that of one good row so far off, which bounds theirs from above."""
    return EffectFound(
        name="misreading",
        also_possible=(),
        belongs_to="stand",
        coefficients={},
        p_value=float(chdtrc(1, GROSS_SIGMA**2)),
    )
