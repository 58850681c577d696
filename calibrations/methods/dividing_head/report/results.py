"""What the reader must know first, and the table of results."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.quantities import (
    format_concise,
    format_expanded,
    format_freedom,
    format_interval,
    format_number,
)
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.core.verdict import Judgement, Model, Outcome
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.analysis import lack_of_fit_warning
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.loop.sentences import comparisons, found_sentences, headline
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.report.values import coverage, limits_text
from tumble.calibrations.report.verdicts import decided
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


def notices(subject: Subject) -> list[str]:
    """What the reader must know before the numbers, one sentence each."""
    calibration = subject.calibration
    found: list[str] = []
    if not calibration.observations.complete:
        found.append(Message("The recording is incomplete: the result rests on the rows before it was cut off."))
    said_below = lack_of_fit_warning(calibration.observations.source, calibration.lack_of_fit_p)
    found.extend(each for each in dict.fromkeys(calibration.warnings) if each != said_below)
    found.extend(_of_the_model(subject))
    if subject.provenance.git_dirty:
        found.append(Message("The program that computed this had changes that are in no commit."))
    return found


def _of_the_model(subject: Subject) -> Iterator[str]:
    """Whether the model of the values to use describes the data, and what was found beyond the declared one."""
    loop, p_value = subject.loop, subject.use.calibration.lack_of_fit_p
    unfit, otherwise = p_value is not None and p_value < LACK_OF_FIT_P, bool(loop and comparisons(loop))
    if p_value is not None and unfit and not otherwise:
        yield Message(
            "The declared model does not describe the data: the poses disagree with it by more than the repeats "
            "explain (p {p_value}). The uncertainties rest on that disagreement.",
            p_value=equals(p_value),
        )
    if loop and found_sentences(loop):
        rest = [Message("The uncertainties rest on that disagreement.")] if unfit and otherwise else []
        below = Message("What that does to the parameters is said below the results.")
        yield Message.joined(" ", [headline(loop), *rest, below])


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


def result_sections(subject: Subject) -> Iterator[Section]:
    """The values with their intervals and degrees of freedom, and why a parameter has none."""
    found = results(subject)
    rows: list[ResultRow] = found["rows"]
    limited = (Message("Limits"), Message("Verdict")) if found["has_limits"] else ()
    yield Section(
        title="",
        lines=[
            *([_AUGMENTED] if found["augmented"] else []),
            *map(_why_none, (row for row in rows if row.reason)),
            *(
                Message("What would decide {name}: {remedy}.", name=each.name, remedy=each.remedy)
                for each in subject.verdict.parameters
                if each.remedy
            ),
        ],
        caption=Message(
            "± is the expanded uncertainty for a coverage probability of 95%, k times the standard uncertainty u, or "
            "for alpha0 the interval of its likelihood profile; ν are the effective degrees of freedom. g is local "
            "gravity."
        ),
        headings=(
            Message("Parameter"),
            Message("Value ± U"),
            Message("95% interval"),
            "k",
            "u",
            "ν",
            Message("Condition"),
            *limited,
        ),
        rows=[(*_cells(row), *((row.limits, row.verdict) if limited else ())) for row in rows],
    )
    yield Section(
        title="",
        caption=Message(
            "The same coefficients per m/s² with their standard uncertainty, that of local gravity included."
        ),
        headings=(Message("Parameter"), Message("Value (standard uncertainty)")),
        rows=found["per_acceleration"],
    )


_AUGMENTED: Final = Message(
    "These are the values with what was found taken into account. Those of the declared model alone, which does not "
    "describe these data, stand under: What the model left unexplained."
)


def _why_none(row: ResultRow) -> Message:
    reason = Message("{name} is not identifiable: {reason}.", name=row.name, reason=row.reason)
    if not row.remedy:
        return reason
    return Message("{said} A sweep in {mounts} would settle it.", said=reason, mounts=row.remedy)


def _cells(row: ResultRow) -> tuple[str, ...]:
    value = Message("not identifiable") if row.reason else row.value
    return row.name, value, row.interval, row.coverage, row.standard, row.freedom, row.note


def _row(parameter: Parameter, check: LimitCheck | None, judgement: Judgement | None) -> ResultRow:
    cells: dict[str, Any] = {}
    if check and judgement:
        limits = limits_text(parameter, check)
        cells = {"limits": limits, "verdict": decided(parameter, check, judgement), "outcome": judgement.outcome}
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
        value=format_expanded(parameter.value, parameter.interval_95, parameter.unit),
        interval=format_interval(*parameter.interval_95, parameter.unit),
        coverage=coverage(parameter),
        standard=_alone(parameter.standard_uncertainty, parameter.unit),
        freedom=format_freedom(parameter.degrees_of_freedom),
        note=_note(parameter),
        **cells,
    )


def _alone(uncertainty: float, unit: str) -> str:
    return format_number(uncertainty, unit, 2)


def _note(parameter: Parameter) -> str:
    if parameter.given:
        return parameter.condition
    return Message("rests on {name}", name=parameter.rests_on) if parameter.rests_on else ""
