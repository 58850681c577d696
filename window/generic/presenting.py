"""A result of any method as the screen Result shows it: its parameters, its warnings and its sections."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tumble.calibrations.core.method import Result
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import (
    format_concise,
    format_interval,
    format_limits,
    format_number,
    format_quantity,
)
from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.core.view import Section
from tumble.window.work.activity import Concluded
from tumble.window.work.presentation import ParameterLine, Presentation

if TYPE_CHECKING:
    from tumble.calibrations.records.entry import Entry


@dataclass(frozen=True, kw_only=True)
class SectionPresentation(Presentation):
    """What the tab Details shows beside."""

    sections: Sequence[Section]


def sections_of(presentation: Presentation) -> Sequence[Section]:
    """The sections of a result that was presented here."""
    assert isinstance(presentation, SectionPresentation), "a result is shown by the part that presented it"
    return presentation.sections


def present(concluded: Concluded) -> SectionPresentation:
    """Work out what there is to show of a `tumble.calibrations.core.method.Result`."""
    result: Result = concluded.traced
    entry = result.entry()
    return SectionPresentation(
        concluded=concluded,
        verdict=entry.verdict,
        notices=result.warnings,
        table=[_line(parameter, entry) for parameter in result.parameters.values()],
        sections=result.sections(),
    )


def _line(parameter: Parameter, entry: "Entry") -> ParameterLine:
    judged = entry.verdict.of(parameter.name)
    limits = [
        format_limits(check.minimum, check.maximum, parameter.unit)
        for check in entry.limits
        if check.name == parameter.name
    ]
    value, interval, standard = _numbers(parameter)
    return ParameterLine(
        name=parameter.name,
        value=value,
        interval=interval,
        standard=standard,
        note=parameter.condition,
        reason=parameter.reason if parameter.value is None else "",
        limits=limits[0] if limits else "",
        verdict=judged.outcome.words if judged else "",
        outcome=judged.outcome if judged else Outcome.NO_LIMITS,
    )


def _numbers(parameter: Parameter) -> tuple[str, str, str]:
    """Value, 95% interval and standard uncertainty as text, empty where there is none."""
    if parameter.value is None:
        return "", "", ""
    unit, standard = parameter.unit, parameter.standard_uncertainty
    alone = "" if standard is None else format_number(standard, unit, 2)
    if parameter.interval_95 is None:
        return format_concise(parameter.value, standard, unit), "", alone
    low, high = parameter.interval_95
    return format_quantity(parameter.value, (high - low) / 2, unit), format_interval(low, high, unit), alone
