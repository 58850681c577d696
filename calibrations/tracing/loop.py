"""Closing the loop: what is left, to what it is traced, and what that does to parameters and error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtrc

from calibrations.analysis import assess
from calibrations.budget import StandUncertainty
from calibrations.effects import CATALOGUE
from calibrations.effects.effect import Effect, Quantity
from calibrations.effects.unnamed import Structure
from calibrations.gross import unlike_repeats
from calibrations.joint import Joint, fit_jointly, fit_without
from calibrations.model import PARAMETERS
from calibrations.observations import Observations, SetAside
from calibrations.repeats import pose_groups
from calibrations.result import Calibration, Parameter
from calibrations.tracing.augmented import Augmented, augment
from calibrations.tracing.ground import Ground, ground, scene_of
from calibrations.tracing.misreading import Misreading, misreadings
from calibrations.tracing.noise import NoiseModel
from calibrations.tracing.rivals import CLOSE, Rival, names, rivals, with_best_names
from calibrations.tracing.trace import WALK_PRICE, Found, Trace, Tracer

RIVALS_APART = 2.0
"""A parameter that differs between rivals by more than so many standard uncertainties cannot be told."""


@dataclass(frozen=True, kw_only=True)
class EffectFound:
    """An effect of the catalogue that the data shows."""

    name: str
    also_possible: tuple[str, ...]
    belongs_to: str
    coefficients: Mapping[str, Quantity]
    p_value: float


@dataclass(frozen=True, kw_only=True)
class Unexplained:
    """Structure that is there and that no effect of the catalogue explains."""

    depends_on: str
    description: str


@dataclass(frozen=True, kw_only=True)
class Loop:
    """The loop closed on one table."""

    declared: Calibration
    augmented: Calibration
    effects: tuple[EffectFound, ...]
    """In the order of the evidence."""
    unexplained: Unexplained | None
    misread: tuple[Misreading, ...]


def close_loop(
    observations: Observations, stand: StandUncertainty | None = None, effects: Sequence[Effect] = CATALOGUE
) -> Loop:
    """Fit the declared model, trace what it leaves, add what was found, and say what that changes.

    Raises
    ------
    ValueError
        No voltage, or no usable row.
    """
    uncertainty = stand or StandUncertainty()
    declared = fit_jointly(observations)
    explained = _explained(declared, effects)
    for _ in range(_ROUNDS):
        rejected = _gross_errors(observations, explained)
        if {entry.row for entry in rejected} == _rejected_rows(explained.base.joint):
            break
        explained = _explained(fit_without(observations, rejected), effects)
    tracer, trace, best = explained.tracer, explained.trace, explained.best
    close = {name: _close(tracer, trace, name) for name in names(trace)}
    misread = misreadings(observations, best.joint)
    augmented = _with_rivals(assess(best.joint, uncertainty, trials=0), explained.base, trace, close)
    return Loop(
        declared=assess(declared, uncertainty, trials=0),
        augmented=augmented,
        effects=_effects(explained.base, trace, best, close, misread),
        unexplained=_unexplained(trace),
        misread=misread,
    )


_ROUNDS = 2
"""How often gross errors are judged anew once effects are known."""


@dataclass(frozen=True, kw_only=True)
class _Explained:
    """A table without gross errors, and what it was traced to."""

    base: Ground
    tracer: Tracer
    trace: Trace
    best: Augmented


def _explained(joint: Joint, effects: Sequence[Effect]) -> _Explained:
    base = ground(joint)
    tracer = Tracer(base, effects)
    trace = with_best_names(tracer, tracer.trace())
    return _Explained(base=base, tracer=tracer, trace=trace, best=augment(base, trace))


def _rejected_rows(joint: Joint) -> set[int]:
    return {entry.row for entry in joint.observations.set_aside if entry.reason.startswith("gross error")}


def _gross_errors(observations: Observations, explained: _Explained) -> tuple[SetAside, ...]:
    """Gross errors of the whole table as the augmented model sees them: an effect may have looked like one."""
    joint = explained.best.joint
    scene = scene_of(observations, joint.fit.theta)
    residual = explained.best.residual_v(scene)
    spare = len(joint.observations) - joint.fit.fitted
    return unlike_repeats(observations.row, residual, pose_groups(observations), joint.noise.used_v, spare)


def _close(tracer: Tracer, trace: Trace, name: str) -> list[Rival]:
    return [rival for rival in rivals(tracer, trace, name) if rival.behind < CLOSE]


def _effects(
    base: Ground,
    trace: Trace,
    best: Augmented,
    close: Mapping[str, Sequence[Rival]],
    misread: Sequence[Misreading],
) -> tuple[EffectFound, ...]:
    found = [_effect(base, trace, best, name, close[name]) for name in names(trace)]
    if trace.noise.walk:
        found.append(_walk(base, trace, best.joint))
    if misread:
        found.append(_misreading(misread))
    return tuple(sorted(found, key=lambda effect: effect.p_value))


def _effect(base: Ground, trace: Trace, best: Augmented, name: str, close: Sequence[Rival]) -> EffectFound:
    items = [item for item in trace.found if item.effect.name == name]
    without = [item.form for item in trace.found if item.effect.name != name]
    gain = base.deviance(without, trace.noise) - trace.deviance
    width = sum(item.form.columns.shape[1] for item in items)
    return EffectFound(
        name=name,
        also_possible=tuple(rival.found.effect.name for rival in close),
        belongs_to=items[0].effect.belongs_to,
        coefficients=best.quantities(name),
        p_value=float(chdtrc(width, max(gain, 0.0))),
    )


def _walk(base: Ground, trace: Trace, joint: Joint) -> EffectFound:
    """Random walk: the variance of the first mode is q T / π² (Karhunen-Loève expansion of the centred walk)."""
    hours = base.scene.hours
    span_h = float(np.ptp(hours)) if hours is not None else 1.0
    rate = float(joint.noise.used_v * np.pi * np.sqrt(trace.noise.walk / span_h))
    gain = base.deviance([item.form for item in trace.found], NoiseModel()) - trace.deviance
    return EffectFound(
        name="bias_random_walk",
        also_possible=(),
        belongs_to="unit",
        coefficients={"bias_random_walk": Quantity(value=rate, standard_uncertainty=rate / 4.0, unit="V/√h")},
        p_value=float(chdtrc(1, max(gain - WALK_PRICE, 0.0))),
    )


def _misreading(misread: Sequence[Misreading]) -> EffectFound:
    return EffectFound(
        name="misreading", also_possible=(), belongs_to="stand", coefficients={}, p_value=float(0.0 * len(misread))
    )


def _unexplained(trace: Trace) -> Unexplained | None:
    if not trace.unnamed:
        return None
    structures = [item for item in trace.unnamed if isinstance(item.effect, Structure)]
    first = structures[0]
    assert isinstance(first.effect, Structure)
    return Unexplained(depends_on=first.effect.depends_on, description=first.effect.describe(first.form))


def _with_rivals(
    calibration: Calibration, base: Ground, trace: Trace, close: Mapping[str, Sequence[Rival]]
) -> Calibration:
    """Take back the parameters that depend on which of two rivals is true."""
    parameters = dict(calibration.parameters)
    for name, listed in close.items():
        kept = [item for item in trace.found if item.effect.name != name]
        for rival in listed:
            theta = augment(base, trace, [*kept, rival.found]).joint.fit.theta
            for index, parameter in enumerate(PARAMETERS):
                parameters[parameter] = _judged(parameters[parameter], float(theta[index]), name, rival.found)
    return replace(calibration, parameters=parameters)


def _judged(parameter: Parameter, other: float, name: str, rival: Found) -> Parameter:
    if parameter.value is None or parameter.standard_uncertainty is None:
        return parameter
    if abs(other - parameter.value) <= RIVALS_APART * parameter.standard_uncertainty:
        return parameter
    reason = f"it differs between {name} and {rival.effect.name}, which this experiment cannot tell apart"
    return replace(parameter, value=None, standard_uncertainty=None, type_a=None, interval_95=None, reason=reason)
