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
        "judged": str(verdict.judged),
        "decided": [judgement.sentence for judgement in verdict.parameters],
        "notices": notices(subject),
    }


_MARKS = {Outcome.PASS: "✓", Outcome.FAIL: "✗", Outcome.NOT_DECIDED: "?"}


def headline(verdict: Verdict) -> str:
    """What is decided, in a few words; empty where there are no limits."""
    outside, undecided = verdict.named(Outcome.FAIL), verdict.named(Outcome.NOT_DECIDED)
    if verdict.outcome is Outcome.PASS:
        return "Inside the limits"
    parts = [
        f"Outside the limits: {series(outside)}" if outside else "",
        f"{'not' if outside else 'Not'} decided: {series(undecided)}" if undecided else "",
    ]
    return "; ".join(filter(None, parts))


def notices(subject: Subject) -> list[str]:
    """What the reader must know before the numbers, one sentence each."""
    calibration = subject.calibration
    found = []
    if not calibration.observations.complete:
        found.append("The recording is incomplete: the result rests on the rows before it was cut off.")
    found.extend(dict.fromkeys(calibration.warnings))
    untold = [name for name, parameter in subject.use.calibration.parameters.items() if parameter.value is None]
    if untold:
        found.append(f"This data cannot tell {series(untold, 'or')}; the table of results says why.")
    if calibration.lack_of_fit_p is not None and calibration.lack_of_fit_p < LACK_OF_FIT_P:
        found.append(
            "The declared model does not describe the data: the poses disagree with it by more than the repeats "
            f"explain (p {equals(calibration.lack_of_fit_p)}). The uncertainties rest on that disagreement."
        )
    if subject.loop and (traced := found_sentences(subject.loop)):
        found.append(" ".join((*traced, "What that does to the parameters is said below the results.")))
    if subject.provenance.git_dirty:
        found.append("The program that computed this had changes that are in no commit.")
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
    if parameter.given_alpha0_deg is not None:
        return f"given alpha0 = {parameter.given_alpha0_deg:g}°"
    return f"rests on {parameter.rests_on}" if parameter.rests_on else ""


def _decided(parameter: Parameter, check: LimitCheck, judgement: Judgement) -> str:
    """Inside or outside, and whether the 95% interval reaches over the limit; or that it is not decided."""
    if judgement.outcome is Outcome.NOT_DECIDED or parameter.interval_95 is None:
        return "not decided: no value" if parameter.value is None else "not decided"
    low, high = parameter.interval_95
    wholly = (check.minimum is None or low >= check.minimum) and (check.maximum is None or high <= check.maximum)
    beyond = (check.minimum is not None and high < check.minimum) or (check.maximum is not None and low > check.maximum)
    if judgement.outcome is Outcome.PASS:
        return "inside" if wholly else "inside, but the interval reaches out"
    return "outside" if beyond else "outside, but the interval reaches in"
