"""The page on a head and its reference: residual, causes, what is left, what would tell rivals apart, error before
and after.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.quantities import format_concise, format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.dividing_head.loop.sentences import findings
from tumble.calibrations.methods.head_reference.changes import Comparison
from tumble.calibrations.methods.head_reference.head_map import head_map
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.sentences import (
    CHANGES_HEADINGS,
    PARTS_HEADINGS,
    SETTINGS_HEADINGS,
    change_rows,
    headline,
    part_rows,
    sentences,
    setting_rows,
)
from tumble.calibrations.report.drawing import COLOURS, INK, WIDE_IN, sheet, styled, to_svg
from tumble.calibrations.report.stand import head_map_figure
from tumble.calibrations.report.tables_page import Part, page
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.sentences import unexplained_sentence


def render_head(name: str, loop: ReferenceLoop, against: tuple[str, Comparison] | None = None) -> str:
    """The whole page; `against` is the name of an earlier table of the same head, and how this one differs from it."""
    compared = [] if against is None else list(_difference(against[1], against[0], name))
    return page("A dividing head measured against a reference", name, [*compared, *_parts(loop)], loop.warnings)


def _difference(comparison: Comparison, first: str, second: str) -> Iterator[Part]:
    yield Part(
        title=f"{second} minus {first}",
        lines=[
            *sentences(comparison, first, second),
            *(f"In the difference: {unexplained_sentence(each)}" for each in comparison.unexplained),
        ],
        headings=[heading.capitalize() for heading in PARTS_HEADINGS],
        rows=part_rows(comparison),
    )
    yield Part(
        title="What the difference shows",
        headings=[heading.capitalize() for heading in CHANGES_HEADINGS],
        rows=change_rows(comparison),
    )


def _parts(loop: ReferenceLoop) -> Iterator[Part]:
    if loop.not_traced:
        yield Part(title="To what it was traced", lines=[_sentence(headline(loop))])
        return
    yield Part(
        title="What a constant offset leaves",
        figure=residual_figure(loop, loop.explanation.before_deg, "before"),
        caption="Reference minus head, mean taken off, against the angle of the head; each way in its own colour.",
    )
    yield Part(
        title="To what it was traced",
        lines=[_sentence(headline(loop)), *(unexplained_sentence(each) for each in loop.unexplained)],
        headings=("Effect", "Could also be", "Belongs to", "Coefficients", "p"),
        rows=[
            (each.name, each.also_possible or "told apart", each.belongs_to, each.coefficients, each.p_value)
            for each in findings(loop.effects)
        ],
    )
    yield Part(
        title="Error by setting",
        caption="Means of the repeats of each setting, with standard uncertainties from their pooled scatter.",
        headings=[heading.capitalize() for heading in SETTINGS_HEADINGS],
        rows=setting_rows(loop.by_setting),
    )
    yield Part(title="What would tell rivals apart", lines=[_next(each) for each in loop.next_experiment])
    yield Part(
        title="Before and after",
        figure=residual_figure(loop, loop.explanation.residual_deg, "after"),
        caption="What is left once everything that was found is taken off.",
        headings=("", "Constant offset", "With what was found"),
        rows=list(_comparison(loop)),
    )
    yield Part(title="What the table cannot tell", lines=loop.limits)
    if found := head_map(loop):
        yield Part(
            title="Head map",
            figure=head_map_figure(found),
            caption="True minus reported angle by the harmonics and the backlash that were found, with two standard "
            "uncertainties. Latency and what adds up from turn to turn are no part of it.",
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
        return f"cannot be told: {stated.reason}"
    return format_concise(stated.value, stated.standard_uncertainty, stated.unit)


def _deg(value: float | None) -> str:
    return "none" if value is None else format_number(value, "deg")


@styled
def residual_figure(loop: ReferenceLoop, residual_deg: FloatArray, name: str) -> Markup:
    """A residual, shape (dwells,), against the angle of the head, each way and rests apart."""
    scene = loop.explanation.scene
    speed = scene.velocity_deg_s
    still = np.zeros(scene.rows, dtype=bool) if speed is None or not speed.any() else np.abs(speed) < 1e-3
    kinds = {
        "forward": (scene.direction > 0) & ~still,
        "backward": (scene.direction < 0) & ~still,
        "at rest": still | (scene.direction == 0),
    }
    figure, (panel,) = sheet(WIDE_IN, 2.6)
    panel.axhline(0.0, color=INK, linewidth=0.7)
    for number, (label, chosen) in enumerate(kinds.items()):
        if chosen.any():
            marker = "o^s"[number]
            panel.plot(
                *(scene.angle_deg[chosen], residual_deg[chosen]), linestyle="", marker=marker, markersize=2.5,
                markeredgewidth=0, color=COLOURS[number], label=label,
            )  # fmt: skip
    panel.set_xlabel("head angle as reported (°)")
    panel.set_ylabel("reference - head (°)")
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return to_svg(figure, f"residual-{name}", f"Residual against head angle, {name} what was found is taken off")
