"""Why a number decides no verdict: each reason with the remedy."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.messages import Message

if TYPE_CHECKING:
    from tumble.calibrations.methods.dividing_head.loop.loop import Loop

CLOSURE_P: Final = LACK_OF_FIT_P / 10
"""Below this the flips contradict the model. The test of fit has spent its one error in a hundred already."""
SCATTER_P: Final = 1 - LACK_OF_FIT_P / 10
"""Above this p of the test of fit, repeats differ as wholes."""
_SEARCH: Final = Message("search for the cause, or measure again; tumble close-loop traces what the model leaves")


@dataclass(frozen=True, kw_only=True)
class Doubt:
    """Why nothing is decided."""

    reason: str
    """To stand after a colon."""
    remedy: str


def missing(parameter: Parameter, loop: "Loop | None") -> Doubt | None:
    """A parameter without a value, or without an uncertainty."""
    if parameter.value is not None and parameter.interval_95 is not None:
        return None
    if parameter.settled_by:
        return Doubt(reason=_no_value(parameter.reason), remedy=_sweep(parameter.settled_by))
    reason = parameter.reason or Message("no uncertainty can be stated")
    remedy = _next(loop) or Message(
        "measure with a programme that turns the unit so that it is identifiable, such as reversal"
    )
    return Doubt(reason=_no_value(reason), remedy=remedy)


def _no_value(reason: str) -> Message:
    return Message("no value: {reason}", reason=reason)


def condition(parameter: Parameter) -> Doubt | None:
    """A value that rests on another parameter; what a hidden effect could do to a verdict is asked for each limit."""
    if parameter.rests_on_absence:
        return None
    if parameter.rests_on:
        reason = Message("it rests on {name} alone", name=parameter.rests_on)
    elif parameter.given:
        ((name, value),) = parameter.given.items()
        reason = Message("it stands for {name} = {value_deg:g}° only", name=name, value_deg=value)
    else:
        return None
    if parameter.remark:
        reason = Message("{reason}: {remark}", reason=reason, remark=parameter.remark)
    remedy = _sweep(parameter.settled_by) if parameter.settled_by else Message("measure in another mount too")
    return Doubt(reason=reason, remedy=remedy)


def contradiction(calibration: Calibration, loop: "Loop | None") -> Doubt | None:
    """A model that the data, or the loop, contradicts: then none of its values decides."""
    if loop is not None and loop.augmented is loop.declared:  # only what is not traced at all was fitted but once
        return Doubt(reason=loop.not_traced, remedy=Message("correct the table, or say what it is"))
    if loop is not None and loop.unexplained is not None:
        left = loop.unexplained
        reason = Message(
            "no effect of the catalogue explains what depends on {depends_on}: {description}",
            depends_on=left.depends_on,
            description=left.description,
        )
        return Doubt(reason=reason, remedy=_next(loop) or _SEARCH)
    return _misfit(calibration, loop)


def _misfit(calibration: Calibration, loop: "Loop | None") -> Doubt | None:
    found = loop is not None and bool(loop.effects)
    model = Message("the model with what was found") if found else Message("the declared model")
    remedy = _next(loop) or _SEARCH
    p_value, closure = calibration.lack_of_fit_p, calibration.closure
    if p_value is not None and p_value < LACK_OF_FIT_P:
        reason = Message(
            "{model} does not describe the poses (lack of fit: p {p_value})", model=model, p_value=equals(p_value)
        )
        return Doubt(reason=reason, remedy=remedy)
    if p_value is not None and p_value > SCATTER_P:
        reason = Message(
            "repeats scatter far more than the poses about the model: something changes between the realisations"
        )
        return Doubt(reason=reason, remedy=remedy)
    if closure is not None and closure.p_value is not None and closure.p_value < CLOSURE_P:
        reason = Message("the flips do not agree on u0 (p {p_value})", p_value=equals(closure.p_value))
        return Doubt(reason=reason, remedy=remedy)
    return None


def _sweep(mounts: Sequence[str]) -> str:
    """What to run where a sweep in one of several mounts would settle it."""
    probed = next((mount for mount in mounts if mount != "face-up"), "repeat")
    return Message(
        "one sweep in {mounts} would settle it: {command}, then tumble close-loop with both files",
        mounts=series(mounts, "or"),
        command=f"tumble run --programme probe-{probed} --serial SERIAL",
    )


def _next(loop: "Loop | None") -> str:
    """The experiments that the loop asks for; empty where it asks for none."""
    if loop is None:
        return ""
    commands = dict.fromkeys(experiment.command for experiment in loop.next_experiment if experiment.command)
    if commands:
        return Message("{commands}, then tumble close-loop with all files", commands=series([*commands]))
    return next((experiment.why for experiment in loop.next_experiment), "")
