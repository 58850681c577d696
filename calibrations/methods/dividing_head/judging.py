"""Holds the values to use against the limits of a programme.

Decision rule: simple acceptance (JCGM 106:2012, 8.2). A value inside its limits conforms, one at a limit too, provided
that the measurement is capable: its capability index C_m = T/(2U) (JCGM 106:2012, 7.6) is no less than 1, so that the
95% interval is no wider than the tolerance T; or that the whole interval lies on one side of every limit. Where only
one limit is given, its distance from zero stands for T/2. What has no value, or one that rests on something that was
not measured, or that is of a model which the data contradicts, decides nothing; nor does a value that an effect which
these data cannot show could carry over a limit.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, inside
from tumble.calibrations.core.quantities import format_interval, format_limits, format_number
from tumble.calibrations.core.verdict import Judgement, Outcome, Verdict
from tumble.calibrations.methods.dividing_head.doubts import Doubt, condition, contradiction, missing
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.methods.dividing_head.unseen import MATERIAL, Unseen, unseen
from tumble.calibrations.methods.dividing_head.usable import usable
from tumble.messages import Message, with_wording

if TYPE_CHECKING:
    from tumble.calibrations.methods.dividing_head.loop.loop import Loop


def judge(declared: Calibration, limits: Sequence[LimitCheck], loop: "Loop | None" = None) -> Verdict:
    """Hold the values to use against the limits.

    Parameters
    ----------
    declared
        The fit of the declared model.
    limits
        Limits by parameter; none gives `no_limits`.
    loop
        The loop closed on the same rows; without it the declared model is judged by its own tests alone.
    """
    use = usable(declared, loop)
    doubts = [_doubt(use.calibration, each, loop) for each in limits]
    hidden = unseen(use.calibration) if any(doubt is None for doubt in doubts) else ()
    return Verdict(
        judged=use.model,
        parameters=tuple(
            _judged(use.calibration.parameters[each.name], each, doubt or _carried_over(use.calibration, each, hidden))
            for each, doubt in zip(limits, doubts, strict=True)
        ),
    )


def _doubt(calibration: Calibration, limits: LimitCheck, loop: "Loop | None") -> Doubt | None:
    parameter = calibration.parameters[limits.name]
    return (
        missing(parameter, loop)
        or condition(parameter)
        or contradiction(calibration, loop)
        or _incapable(parameter, limits)
    )


def _judged(parameter: Parameter, limits: LimitCheck, doubt: Doubt | None) -> Judgement:
    if doubt is not None:
        return Judgement(name=parameter.name, outcome=Outcome.NOT_DECIDED, reason=doubt.reason, remedy=doubt.remedy)
    assert parameter.value is not None, "what is missing was asked first"
    outcome = Outcome.PASS if inside(parameter.value, limits) else Outcome.FAIL
    return Judgement(name=parameter.name, outcome=outcome, reason=_where(parameter, limits, outcome))


def _where(parameter: Parameter, limits: LimitCheck, outcome: Outcome) -> Message:
    assert parameter.value is not None, "what is missing was asked first"
    value, text = format_number(parameter.value, parameter.unit, 6), _text(parameter, limits)
    if outcome is Outcome.PASS:
        return Message("{value} lies inside {limits}", value=value, limits=text)
    return Message("{value} lies outside {limits}", value=value, limits=text)


def _incapable(parameter: Parameter, limits: LimitCheck) -> Doubt | None:
    """Whether the uncertainty is too large for these limits."""
    assert parameter.interval_95 is not None, "what is missing was asked first"
    low, high = parameter.interval_95
    spanned = (limits.minimum is not None and low < limits.minimum <= high) or (
        limits.maximum is not None and low <= limits.maximum < high
    )
    if not spanned or high - low <= _tolerance(limits):
        return None
    interval = format_interval(low, high, parameter.unit)
    return Doubt(
        reason=Message(
            "the uncertainty is too large for {limits}: the 95% interval is {interval}",
            limits=_text(parameter, limits),
            interval=interval,
        ),
        remedy=Message("measure with more realisations or less noise, or state better the uncertainties of the stand"),
    )


def _carried_over(calibration: Calibration, limits: LimitCheck, hidden: Sequence[Unseen]) -> Doubt | None:
    """Whether an effect that these data cannot show could carry a value over a limit."""
    parameter = calibration.parameters[limits.name]
    value, uncertainty = parameter.value, parameter.standard_uncertainty
    assert value is not None, "what is missing was asked first"
    for each in hidden:
        other = each.parameters[limits.name]
        far = abs(other - value) > MATERIAL * (uncertainty or 0.0)
        if far and inside(other, limits) != inside(value, limits):
            return Doubt(
                reason=Message(
                    "it rests on the absence of {effect}, which these data cannot show: the largest that they "
                    "could hide would carry it over the limits, {limits}",
                    effect=with_wording(each.effect),
                    limits=_text(parameter, limits),
                ),
                remedy=Message("measure in more mounts, as the programme reversal does, which separates the two"),
            )
    return None


def _tolerance(limits: LimitCheck) -> float:
    if limits.minimum is not None and limits.maximum is not None:
        return limits.maximum - limits.minimum
    only = limits.maximum if limits.minimum is None else limits.minimum
    return 2.0 * abs(only or 0.0)


def _text(parameter: Parameter, limits: LimitCheck) -> str:
    return format_limits(limits.minimum, limits.maximum, parameter.unit)
