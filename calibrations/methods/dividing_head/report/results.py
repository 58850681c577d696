"""The front of the report: verdict, what the reader must know first, and the table of results."""

from dataclasses import dataclass
from typing import Any

from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.quantities import (
    format_concise,
    format_freedom,
    format_interval,
    format_limits,
    format_number,
    format_quantity,
    rounded,
)
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.loop.sentences import found_sentences
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class ResultRow:
    """One line of the result table, every cell as text."""

    name: str
    value: str
    """Value and expanded uncertainty with the unit."""
    interval: str
    coverage: str
    standard: str
    freedom: str
    note: str
    """The condition under which the value stands, or on what it rests."""
    reason: str = ""
    """Why there is no value; the cells before it are empty then."""
    remedy: str = ""
    limits: str = ""
    verdict: str = ""
    outcome: Outcome = Outcome.NO_LIMITS


def header(subject: Subject) -> dict[str, Any]:
    """Verdict and notices, for the head of the page."""
    verdict = subject.verdict
    return {
        "verdict": headline(verdict),
        "mark": _MARKS.get(verdict.outcome, ""),
        "outcome": str(verdict.outcome),
        "judged": _JUDGED[verdict.judged],
        "decided": [judgement.sentence for judgement in verdict.parameters],
        "notices": notices(subject),
    }


_JUDGED = {
    Model.DECLARED: Message("Judged: the declared model, by simple acceptance."),
    Model.AUGMENTED: Message("Judged: the augmented model, by simple acceptance."),
}
_MARKS = {Outcome.PASS: "✓", Outcome.FAIL: "✗", Outcome.NOT_DECIDED: "?"}


def headline(verdict: Verdict) -> str:
    """What is decided, in a few words; empty where there are no limits."""
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
    return Message("Not decided: {undecided}", undecided=series(undecided)) if undecided else ""


def notices(subject: Subject) -> list[str]:
    """What the reader must know before the numbers, one sentence each."""
    calibration = subject.calibration
    found: list[str] = []
    if not calibration.observations.complete:
        found.append(Message("The recording is incomplete: the result rests on the rows before it was cut off."))
    found.extend(dict.fromkeys(calibration.warnings))
    lacking = [name for name, parameter in subject.use.calibration.parameters.items() if parameter.value is None]
    if lacking:
        found.append(
            Message.counted(
                "{names} is not identifiable from these data; the table of results says why.",
                "{names} are not identifiable from these data; the table of results says why.",
                count=len(lacking),
                names=series(lacking),
            )
        )
    if calibration.lack_of_fit_p is not None and calibration.lack_of_fit_p < LACK_OF_FIT_P:
        found.append(
            Message(
                "The declared model does not describe the data: the poses disagree with it by more than the repeats "
                "explain (p {p_value}). The uncertainties rest on that disagreement.",
                p_value=equals(calibration.lack_of_fit_p),
            )
        )
    if subject.loop and (traced := found_sentences(subject.loop)):
        below = Message("What that does to the parameters is said below the results.")
        found.append(Message.joined(" ", [*traced, below]))
    if subject.provenance.git_dirty:
        found.append(Message("The program that computed this had changes that are in no commit."))
    return found


def results(subject: Subject) -> dict[str, Any]:
    """The result table and, where local gravity is known, the coefficients per m/s²."""
    checks = {check.name: check for check in subject.limits}
    use, verdict = subject.use, subject.verdict
    return {
        "rows": [_row(p, checks.get(p.name), verdict.of(p.name)) for p in use.calibration.parameters.values()],
        "has_limits": bool(checks),
        "augmented": use.model is Model.AUGMENTED,
        "per_acceleration": [
            (name, format_concise(c.value, c.standard_uncertainty, c.unit))
            for name, c in use.calibration.per_acceleration.items()
        ],
    }


def _row(parameter: Parameter, check: LimitCheck | None, judgement: Judgement | None) -> ResultRow:
    cells: dict[str, Any] = {}
    if check and judgement:
        limits = format_limits(check.minimum, check.maximum, parameter.unit)
        cells = {"limits": limits, "verdict": _decided(parameter, check, judgement), "outcome": judgement.outcome}
    if parameter.value is None or parameter.interval_95 is None or parameter.standard_uncertainty is None:
        return ResultRow(
            name=parameter.name,
            value="",
            interval="",
            coverage="",
            standard="",
            freedom="",
            note="",
            reason=parameter.reason,
            remedy=series(parameter.settled_by, "or") if parameter.settled_by else "",
            **cells,
        )
    return ResultRow(
        name=parameter.name,
        value=expanded(parameter.value, parameter.interval_95, parameter.unit),
        interval=format_interval(*parameter.interval_95, parameter.unit),
        coverage=_coverage(parameter.degrees_of_freedom),
        standard=_alone(parameter.standard_uncertainty, parameter.unit),
        freedom=freedom(parameter.degrees_of_freedom),
        note=_note(parameter),
        **cells,
    )


def expanded(value: float, interval: tuple[float, float], unit: str) -> str:
    """Value and expanded uncertainty; with both sides where they differ in the digits shown."""
    low, high = interval
    text = rounded(value, (high - low) / 2, unit)
    below, above = (rounded(value, side, unit) for side in (value - low, high - value))
    if not text.uncertainty or below.uncertainty == above.uncertainty:
        return format_quantity(value, (high - low) / 2, unit)
    return f"{text.value} (+{above.uncertainty} / -{below.uncertainty}) {text.unit}"


def freedom(degrees_of_freedom: float | None) -> str:
    """Degrees of freedom with the sign for no end, which paper has and a terminal may not."""
    return format_freedom(degrees_of_freedom).replace("inf", "∞")


def _coverage(degrees_of_freedom: float | None) -> str:
    return "" if degrees_of_freedom is None else f"{coverage_factor(degrees_of_freedom):.2f}"


def _alone(uncertainty: float, unit: str) -> str:
    return format_number(uncertainty, unit, 2)


def _note(parameter: Parameter) -> str:
    if parameter.given:
        return parameter.condition
    return Message("rests on {name}", name=parameter.rests_on) if parameter.rests_on else ""


def _decided(parameter: Parameter, check: LimitCheck, judgement: Judgement) -> str:
    """Inside or outside, and whether the 95% interval reaches over the limit; or that it is not decided."""
    if judgement.outcome is Outcome.NOT_DECIDED or parameter.interval_95 is None:
        return Message("not decided: no value") if parameter.value is None else Message("not decided")
    low, high = parameter.interval_95
    wholly = (check.minimum is None or low >= check.minimum) and (check.maximum is None or high <= check.maximum)
    beyond = (check.minimum is not None and high < check.minimum) or (check.maximum is not None and low > check.maximum)
    if judgement.outcome is Outcome.PASS:
        return Message("inside") if wholly else Message("inside, but the interval reaches out")
    return Message("outside") if beyond else Message("outside, but the interval reaches in")
