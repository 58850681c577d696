"""What is shown of a head that is measured against a reference."""

from collections.abc import Iterator, Sequence

from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.head_reference.changes import Comparison
from tumble.calibrations.methods.head_reference.head_map import head_map
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.sentences import (
    CHANGES_HEADINGS,
    PARTS_HEADINGS,
    SETTINGS_HEADINGS,
    change_rows,
    headline,
    most_telling,
    part_rows,
    sentences,
    setting_rows,
)
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.sentences import findings, unexplained_sentence

_MOST_SETTINGS = 40
"""Of more angles than this those are shown that differ most."""


def sections(loop: ReferenceLoop) -> Iterator[Section]:
    """What is shown of one table, the answer first."""
    yield Section(
        title="To what it was traced",
        lines=[_sentence(headline(loop)), *(unexplained_sentence(each) for each in loop.unexplained)],
        headings=("Effect", "Could also be", "Belongs to", "Coefficients", "p"),
        rows=[
            (each.name, each.also_possible or "told apart", each.belongs_to, each.coefficients, each.p_value)
            for each in findings(loop.effects)
        ],
        brief=True,
    )
    if loop.question:
        return
    if not loop.not_traced:
        yield from _before_and_after(loop)
    yield _by_setting(loop)
    yield Section(title="What the table cannot tell", lines=loop.limits, brief=True)
    yield Section(
        title="What would tell rivals apart", lines=[_next(each) for each in loop.next_experiment], brief=True
    )
    if not loop.not_traced and (found := head_map(loop)):
        yield Section(
            title="Head map",
            figure=lambda: _head_map_figure(found),
            caption="True minus reported angle by the harmonics and the backlash that were found, with two standard "
            "uncertainties. Latency and what adds up from turn to turn are no part of it.",
        )


def difference(comparison: Comparison, first: str, second: str) -> Iterator[Section]:
    """What is shown of how two tables of one head differ."""
    yield Section(
        title=f"{second} minus {first}",
        lines=[
            *sentences(comparison, first, second),
            *(f"In the difference: {unexplained_sentence(each)}" for each in comparison.unexplained),
        ],
        headings=[heading.capitalize() for heading in PARTS_HEADINGS],
        rows=part_rows(comparison) if comparison.difference is not None else (),
        brief=True,
    )
    yield Section(
        title="What the difference shows",
        headings=[heading.capitalize() for heading in CHANGES_HEADINGS],
        rows=change_rows(comparison) if comparison.changes else (),
        brief=True,
    )


def _before_and_after(loop: ReferenceLoop) -> Iterator[Section]:
    yield Section(
        title="What a constant offset leaves",
        figure=lambda: residual_figure(loop, loop.explanation.before_deg, "before"),
        caption="Reference minus head, mean taken off, against the angle of the head; each way in its own colour.",
    )
    yield Section(
        title="Before and after",
        figure=lambda: residual_figure(loop, loop.explanation.residual_deg, "after"),
        caption="What is left once everything that was found is taken off.",
        headings=("", "Constant offset", "With what was found"),
        rows=list(_comparison(loop)),
        brief=True,
    )


def _by_setting(loop: ReferenceLoop) -> Section:
    """The error of each angle as its repeats say it; of many angles those with the largest reversal error."""
    shown, left = most_telling(loop.by_setting, _MOST_SETTINGS)
    return Section(
        title="Error by setting" + (f" (of {left + len(shown)} angles those that differ most)" if left else ""),
        caption="Means of the repeats of each setting, with standard uncertainties from their pooled scatter.",
        headings=[heading.capitalize() for heading in SETTINGS_HEADINGS],
        rows=setting_rows(shown),
    )


def _sentence(words: str) -> str:
    return words[:1].upper() + words[1:]


def _next(experiment: Experiment) -> str:
    first, *others = experiment.separates
    return f"{first} or {series(others, 'or')}: {experiment.why}."


def _comparison(loop: ReferenceLoop) -> Iterator[Sequence[str]]:
    models = (loop.declared, loop.augmented)
    yield "offset", *(_offset(model) for model in models)
    yield "residual, r.m.s.", *(_deg(model.residual_rms) for model in models)
    yield "held-out error, r.m.s.", *(_deg(model.held_out_rms) for model in models)
    if loop.passes:
        yield "forward minus backward, r.m.s.", _deg(loop.passes.before_deg), _deg(loop.passes.after_deg)
    if any(loop.agreements):
        yield "lack of fit against the repeats", *(each.words if each else "" for each in loop.agreements)


def _offset(model: ModelFit) -> str:
    stated = model.parameters["offset"]
    if stated.value is None or stated.standard_uncertainty is None:
        return f"not identifiable: {stated.reason}"
    return format_concise(stated.value, stated.standard_uncertainty, stated.unit)


def _deg(value: float | None) -> str:
    return "none" if value is None else format_number(value, "deg")


def residual_figure(loop: ReferenceLoop, residual_deg: FloatArray, name: str) -> Markup:
    """A residual, shape (dwells,), against the angle of the head, each way and rests apart."""
    from tumble.calibrations.methods.head_reference import figures  # matplotlib takes half a second

    return figures.residual_figure(loop, residual_deg, name)


def _head_map_figure(found: HeadMap) -> Markup:
    from tumble.calibrations.report.maps import head_map_figure  # matplotlib takes half a second

    return head_map_figure(found)
