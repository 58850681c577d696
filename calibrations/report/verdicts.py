"""The verdict in words."""

from typing import Final

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.messages import Message

JUDGED: Final = {
    Model.DECLARED: Message("Judged: the declared model, by simple acceptance."),
    Model.AUGMENTED: Message("Judged: the augmented model, by simple acceptance."),
}


MARKS: Final = {Outcome.PASS: "✓", Outcome.FAIL: "✗", Outcome.NOT_DECIDED: "?", Outcome.NO_LIMITS: ""}
"""Shapes beside the colours."""


_WITHOUT: Final = Message("No limits were stated")


def headline(verdict: Verdict) -> str:
    """What is decided, in a few words."""
    outside, undecided = verdict.named(Outcome.FAIL), verdict.named(Outcome.NOT_DECIDED)
    if verdict.outcome is Outcome.PASS:
        return Message("Inside the limits")
    if outside and undecided:
        return Message(
            "Outside the limits: {outside}; not decided: {undecided}",
            outside=series(outside),
            undecided=series(undecided),
        )
    if outside:
        return Message("Outside the limits: {outside}", outside=series(outside))
    return Message("Not decided: {undecided}", undecided=series(undecided)) if undecided else _WITHOUT


def decided(parameter: Parameter, check: LimitCheck, judgement: Judgement) -> str:
    """Inside or outside, and whether the 95% interval reaches over the limit; or that it is not decided."""
    if judgement.outcome is Outcome.NOT_DECIDED or parameter.interval_95 is None:
        return Message("not decided: no value") if parameter.value is None else Message("not decided")
    low, high = parameter.interval_95
    wholly = (check.minimum is None or low >= check.minimum) and (check.maximum is None or high <= check.maximum)
    beyond = (check.minimum is not None and high < check.minimum) or (check.maximum is not None and low > check.maximum)
    if judgement.outcome is Outcome.PASS:
        return Message("inside") if wholly else Message("inside, but the interval reaches out")
    return Message("outside") if beyond else Message("outside, but the interval reaches in")
