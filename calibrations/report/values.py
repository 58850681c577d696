"""The table of the values to use: a line for each parameter, every cell as text."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.quantities import format_concise, format_expanded, format_limits, format_limits_beside
from tumble.calibrations.core.verdict import Judgement, Outcome
from tumble.calibrations.core.view import Quantity
from tumble.calibrations.report.bars import drawn_bar
from tumble.calibrations.report.dates import dated
from tumble.calibrations.report.document import Front
from tumble.calibrations.report.language import language
from tumble.calibrations.report.limit_bar import limit_bar
from tumble.calibrations.report.verdicts import decided
from tumble.messages import Language, Message

if TYPE_CHECKING:
    from tumble.calibrations.records.changes import Change


_DAY: Final = len("2026-11-03")


@dataclass(frozen=True, kw_only=True)
class Value:
    """One line."""

    symbol: str
    words: str
    value: str
    """Value and expanded uncertainty with the unit; that there is none where it is not identifiable."""
    coverage: str
    """The factor k."""
    note: str
    """The condition under which the value stands, or why there is none."""
    change: str
    """Since the last calibration, and when that was; empty where there was none."""
    limits: str
    bar: str
    """SVG; empty without limits."""
    decided: str
    outcome: str


def values(front: Front) -> Iterator[Value]:
    """The lines of a front page."""
    checks = {check.name: check for check in front.limits}
    for name, parameter in front.parameters.items():
        quantity = front.quantities.get(name) or Quantity(symbol=name, words="")
        yield Value(
            symbol=quantity.symbol,
            words=quantity.words,
            value=Message("not identifiable") if parameter.value is None else stated(parameter),
            coverage=coverage(parameter),
            note=parameter.reason if parameter.value is None else parameter.condition,
            change=_moved(front.changes.get(name)),
            **_against(parameter, checks.get(name), front.verdict.of(name)),
        )


def day_since(change: "Change", language: Language) -> str:
    """The day of the earlier calibration, as a language writes it."""
    return dated(change.since[:_DAY], language)


def _moved(change: "Change | None") -> str:
    if change is None:
        return ""
    return Message("{change} since {date}", change=change.text, date=day_since(change, language()))


def _against(parameter: Parameter, check: LimitCheck | None, judgement: Judgement | None) -> dict[str, str]:
    """How it stands against its limits; empty where it has none."""
    if check is None or judgement is None:
        return {"limits": "", "bar": "", "decided": "", "outcome": str(Outcome.NO_LIMITS)}
    return {
        "limits": limits_text(parameter, check),
        "bar": drawn_bar(limit_bar(parameter, check, judgement.outcome)),
        "decided": decided(parameter, check, judgement),
        "outcome": str(judgement.outcome),
    }


def limits_text(parameter: Parameter, check: LimitCheck) -> str:
    """The limits of a parameter, in the unit of its value where there is one."""
    if parameter.value is None:
        return format_limits(check.minimum, check.maximum, parameter.unit)
    low, high = parameter.interval_95 or (0.0, 0.0)
    uncertainty = (high - low) / 2 if high > low else parameter.standard_uncertainty
    return format_limits_beside(parameter.value, uncertainty, check.minimum, check.maximum, parameter.unit)


def stated(parameter: Parameter) -> str:
    """Value and expanded uncertainty; where no interval is known, the standard uncertainty in brackets."""
    assert parameter.value is not None, "asked of a parameter that has a value"
    if parameter.interval_95 is None:
        return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
    return format_expanded(parameter.value, parameter.interval_95, parameter.unit)


def coverage(parameter: Parameter) -> str:
    """The factor k for 95%; empty where the degrees of freedom are not known."""
    freedom = parameter.degrees_of_freedom
    return "" if freedom is None or parameter.value is None else f"{coverage_factor(freedom):.2f}"
