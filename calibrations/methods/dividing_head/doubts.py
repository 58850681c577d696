"""Why a number decides no verdict: each reason with the remedy."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.result import Calibration

if TYPE_CHECKING:
    from tumble.calibrations.methods.dividing_head.loop.loop import Loop

CLOSURE_P: Final = LACK_OF_FIT_P / 10
"""Below this the flips contradict the model. The test of fit has spent its one error in a hundred already."""
SCATTER_P: Final = 1 - LACK_OF_FIT_P / 10
"""Above this p of the test of fit, repeats differ as wholes."""
_SEARCH: Final = "search for the cause, or measure again; tumble close-loop traces what the model leaves"


@dataclass(frozen=True, kw_only=True)
class Doubt:
    """Why nothing is decided."""

    reason: str
    """Words that go after a colon."""
    remedy: str


def missing(parameter: Parameter, loop: "Loop | None") -> Doubt | None:
    """A parameter without a value, or without an uncertainty."""
    if parameter.value is not None and parameter.interval_95 is not None:
        return None
    if parameter.settled_by:
        return Doubt(reason=f"no value: {parameter.reason}", remedy=_sweep(parameter.settled_by))
    reason = parameter.reason or "no uncertainty can be stated"
    remedy = _next(loop) or "measure with a programme that turns the unit so that it is told, such as reversal"
    return Doubt(reason=f"no value: {reason}", remedy=remedy)


def condition(parameter: Parameter) -> Doubt | None:
    """A value that rests on something that was not measured."""
    if parameter.rests_on:
        reason = f"it rests on {parameter.rests_on} alone"
    elif parameter.given_alpha0_deg is not None:
        reason = f"it stands for alpha0 = {parameter.given_alpha0_deg:g}° only"
    else:
        return None
    remedy = _sweep(parameter.settled_by) if parameter.settled_by else "measure in another mount too"
    return Doubt(reason=f"{reason}: {parameter.remark}" if parameter.remark else reason, remedy=remedy)


def contradiction(calibration: Calibration, loop: "Loop | None") -> Doubt | None:
    """A model that the data, or the loop, contradicts: then none of its values decides."""
    if loop is not None and loop.augmented is loop.declared:  # only what is not traced at all was fitted but once
        return Doubt(reason=loop.not_traced, remedy="correct the table, or say what it is")
    if loop is not None and loop.unexplained is not None:
        left = loop.unexplained
        reason = f"no effect of the catalogue explains what depends on {left.depends_on}: {left.description}"
        return Doubt(reason=reason, remedy=_next(loop) or _SEARCH)
    return _misfit(calibration, loop)


def _misfit(calibration: Calibration, loop: "Loop | None") -> Doubt | None:
    model = "the model with what was found" if loop is not None and loop.effects else "the declared model"
    remedy = _next(loop) or _SEARCH
    p_value, closure = calibration.lack_of_fit_p, calibration.closure
    if p_value is not None and p_value < LACK_OF_FIT_P:
        return Doubt(reason=f"{model} does not describe the poses (lack of fit: p {equals(p_value)})", remedy=remedy)
    if p_value is not None and p_value > SCATTER_P:
        reason = "repeats scatter far more than the poses about the model: something changes between the realisations"
        return Doubt(reason=reason, remedy=remedy)
    if closure is not None and closure.p_value is not None and closure.p_value < CLOSURE_P:
        return Doubt(reason=f"the flips do not agree on u0 (p {equals(closure.p_value)})", remedy=remedy)
    return None


def _sweep(mounts: Sequence[str]) -> str:
    """What to run where a sweep in one of several mounts would settle it."""
    probed = next((mount for mount in mounts if mount != "face-up"), "repeat")
    return (
        f"one sweep in {series(mounts, 'or')} would settle it: tumble run --programme probe-{probed} --serial SERIAL, "
        "then tumble close-loop with both files"
    )


def _next(loop: "Loop | None") -> str:
    """The experiments that the loop asks for; empty where it asks for none."""
    if loop is None:
        return ""
    commands = dict.fromkeys(experiment.command for experiment in loop.next_experiment if experiment.command)
    if commands:
        return f"{series([*commands], 'and')}, then tumble close-loop with all files"
    return next((experiment.why for experiment in loop.next_experiment), "")
