"""What is shown of a head that is measured against a reference."""

from collections.abc import Iterator, Sequence

from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.head_reference.changes import Comparison
from tumble.calibrations.methods.head_reference.figures import before_and_after, residual_figure
from tumble.calibrations.methods.head_reference.head_map import head_map
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.sentences import (
    CHANGES_HEADINGS,
    PARTS_HEADINGS,
    SETTINGS_HEADINGS,
    change_rows,
    headline,
    most_different,
    part_rows,
    sentences,
    setting_rows,
)
from tumble.calibrations.report.maps import head_map_figure
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.sentences import Finding, findings, unexplained_sentence
from tumble.messages import Message

_MOST_SETTINGS = 40
"""Of more angles than this those are shown that differ most."""


def sections(loop: ReferenceLoop) -> Iterator[Section]:
    """What is shown of one table, the answer first."""
    yield Section(
        title=Message("To what it was traced"),
        lines=[Message.capitalised(headline(loop)), *(unexplained_sentence(each) for each in loop.unexplained)],
        headings=(
            Message("Effect"),
            Message("Could also be"),
            Message("Belongs to"),
            Message("Coefficients"),
            "p",
        ),
        rows=[_found(each) for each in findings(loop.effects)],
        brief=True,
    )
    if loop.question:
        return
    if not loop.not_traced:
        yield from _before_and_after(loop)
    yield _by_setting(loop)
    yield Section(title=Message("What the table cannot tell"), lines=loop.limits, brief=True)
    yield Section(
        title=Message("What would tell rivals apart"), lines=[_next(each) for each in loop.next_experiment], brief=True
    )
    if not loop.not_traced and (found := head_map(loop)):
        yield Section(
            title=Message("Head map"),
            figure=lambda: head_map_figure(found),
            caption=Message(
                "True minus reported angle by the harmonics and the backlash that were found, with two standard "
                "uncertainties. Latency and what adds up from turn to turn are no part of it."
            ),
        )


def difference(comparison: Comparison, first: str, second: str) -> Iterator[Section]:
    """What is shown of how two tables of one head differ."""
    yield Section(
        title=Message("{second} minus {first}", first=first, second=second),
        lines=[
            *sentences(comparison, first, second),
            *(
                Message("In the difference: {sentence}", sentence=unexplained_sentence(each))
                for each in comparison.unexplained
            ),
        ],
        headings=PARTS_HEADINGS,
        rows=part_rows(comparison) if comparison.difference is not None else (),
        brief=True,
    )
    yield Section(
        title=Message("What the difference shows"),
        headings=CHANGES_HEADINGS,
        rows=change_rows(comparison) if comparison.changes else (),
        brief=True,
    )


def _before_and_after(loop: ReferenceLoop) -> Iterator[Section]:
    yield Section(
        title=Message("What a constant offset leaves"),
        figure=lambda: residual_figure(loop, loop.explanation.before_deg),
        caption=Message(
            "Reference minus head, mean taken off, against the angle of the head; each way in its own colour."
        ),
    )
    yield Section(
        title=Message("Before and after"),
        figure=lambda: before_and_after(loop),
        caption=Message(
            "Reference minus head against the angle of the head: what a constant offset leaves, and what is left once "
            "everything that was found is taken off."
        ),
        headings=("", Message("Constant offset"), Message("With what was found")),
        rows=list(_comparison(loop)),
        brief=True,
    )


def _by_setting(loop: ReferenceLoop) -> Section:
    """The error of each angle as its repeats say it; of many angles those with the largest reversal error."""
    shown, left = most_different(loop.by_setting, _MOST_SETTINGS)
    title = Message("Error by setting")
    if left:
        title = Message("Error by setting (of {angles} angles those that differ most)", angles=left + len(shown))
    return Section(
        title=title,
        caption=Message("Means of the repeats of each setting, with standard uncertainties from their pooled scatter."),
        headings=SETTINGS_HEADINGS,
        rows=setting_rows(shown),
    )


def _found(finding: Finding) -> tuple[str, ...]:
    also_possible = finding.also_possible or Message("distinguished")
    return finding.name, also_possible, finding.belongs_to, finding.coefficients, finding.p_value


def _next(experiment: Experiment) -> str:
    first, *others = experiment.separates
    return Message("{name} or {others}: {why}.", name=first, others=series(others, "or"), why=experiment.why)


def _comparison(loop: ReferenceLoop) -> Iterator[Sequence[str]]:
    models = (loop.declared, loop.augmented)
    yield Message("offset"), *(_offset(model) for model in models)
    yield Message("residual, r.m.s."), *(_deg(model.residual_rms) for model in models)
    yield Message("held-out error, r.m.s."), *(_deg(model.held_out_rms) for model in models)
    if loop.passes:
        yield Message("forward minus backward, r.m.s."), _deg(loop.passes.before_deg), _deg(loop.passes.after_deg)
    if any(loop.agreements):
        yield Message("lack of fit against the repeats"), *(each.words if each else "" for each in loop.agreements)


def _offset(model: ModelFit) -> str:
    stated = model.parameters["offset"]
    if stated.value is None or stated.standard_uncertainty is None:
        return Message("not identifiable: {reason}", reason=stated.reason)
    return format_concise(stated.value, stated.standard_uncertainty, stated.unit)


def _deg(value: float | None) -> str:
    return Message("none") if value is None else format_number(value, "deg")
