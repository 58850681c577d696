"""What is shown of a closed loop."""

from collections.abc import Iterator

from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.sentences import comparisons, findings_of, headline, leaning, untold


def sections(loop: Loop) -> Iterator[Section]:
    """What was found, the models before and after, what is not identifiable any more, and what to measure next."""
    yield Section(
        title="What was found",
        lines=(headline(loop),),
        headings=("effect", "or", "belongs to", "coefficients (standard uncertainty)", "p"),
        rows=[
            (each.name, each.also_possible, each.belongs_to, each.coefficients, each.p_value)
            for each in findings_of(loop)
        ],
        brief=True,
    )
    yield Section(
        title="Before and after",
        headings=("", "declared model", "with what was found", "change"),
        rows=[(line.name, line.declared, line.augmented, line.change) for line in comparisons(loop)],
        brief=True,
    )
    yield Section(
        title="What is not identifiable",
        lines=[*(f"{name}: {reason}" for name, reason in untold(loop)), *filter(None, [leaning(loop)])],
        brief=True,
    )
    yield Section(
        title="What to measure next",
        lines=[f"{experiment.command}\n  {experiment.why}".strip() for experiment in loop.next_experiment],
        brief=True,
    )
