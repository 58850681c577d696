"""A result of any method as the screen Result shows it: its parameters, its warnings and its sections."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.quantities import (
    format_concise,
    format_expanded,
    format_interval,
    format_number,
)
from tumble.calibrations.core.verdict import Judgement, Outcome, Verdict
from tumble.calibrations.core.view import Section
from tumble.window.work.activity import Concluded
from tumble.window.work.presentation import LoopSummary, ParameterLine, Presentation

if TYPE_CHECKING:
    from tumble.calibrations.tracing.experiments import Experiment


@dataclass(frozen=True, kw_only=True)
class SectionPresentation(Presentation):
    """What the tab Details shows beside."""

    sections: Sequence[Section]


def sections_of(presentation: Presentation) -> Sequence[Section]:
    """The sections of a result that was presented here."""
    assert isinstance(presentation, SectionPresentation), "a result is shown by the part that presented it"
    return presentation.sections


class Analysed(Protocol):
    """What an analysis has to say of itself to be shown."""

    @property
    def warnings(self) -> Sequence[str]:
        """Sentences to be read first."""
        ...

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        ...

    @property
    def limits(self) -> Sequence[LimitCheck]:
        """The values held against the limits of the programme."""
        ...

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against them."""
        ...

    @property
    def next_experiment(self) -> "Sequence[Experiment]":
        """What to measure next, the best first."""
        ...

    def sections(self) -> Iterable[Section]:
        """What is shown beside, the answer first."""
        ...


def present(concluded: Concluded) -> SectionPresentation:
    """Work out what there is to show."""
    analysed: Analysed = concluded.traced
    limits = {check.name: check for check in analysed.limits}
    return SectionPresentation(
        concluded=concluded,
        verdict=analysed.verdict,
        notices=analysed.warnings,
        table=[
            _line(each, limits.get(each.name), analysed.verdict.of(each.name)) for each in analysed.parameters.values()
        ],
        loop=LoopSummary(experiments=analysed.next_experiment) if analysed.next_experiment else None,
        sections=tuple(analysed.sections()),
    )


def _line(parameter: Parameter, check: LimitCheck | None, judged: Judgement | None) -> ParameterLine:
    value, interval, standard = _numbers(parameter)
    return ParameterLine(
        name=parameter.name,
        value=value,
        interval=interval,
        standard=standard,
        note=parameter.condition,
        reason=parameter.reason if parameter.value is None else "",
        limits=_limits(parameter, check) if check else "",
        verdict=judged.outcome.words if judged else "",
        outcome=judged.outcome if judged else Outcome.NO_LIMITS,
    )


def _limits(parameter: Parameter, check: LimitCheck) -> str:
    from tumble.calibrations.report.values import limits_text  # a report takes time: a window is up before that

    return limits_text(parameter, check)


def _numbers(parameter: Parameter) -> tuple[str, str, str]:
    """Value, 95% interval and standard uncertainty as text, empty where there is none."""
    if parameter.value is None:
        return "", "", ""
    unit, standard = parameter.unit, parameter.standard_uncertainty
    alone = "" if standard is None else format_number(standard, unit, 2)
    if parameter.interval_95 is None:
        return format_concise(parameter.value, standard, unit), "", alone
    interval = parameter.interval_95
    return format_expanded(parameter.value, interval, unit), format_interval(*interval, unit), alone
