"""What is shown of a closed loop."""

from collections.abc import Iterator

from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.sentences import comparisons, findings_of, headline, leaning, untold
from tumble.calibrations.tracing.experiments import Experiment


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
        lines=[
            *(f"- {name} is not identifiable: {reason}" for name, reason in untold(loop)),
            *(f"- {leans}" for leans in [leaning(loop)] if leans),
        ],
        brief=True,
    )
    yield Section(
        title="What to measure next",
        lines=[line for experiment in loop.next_experiment for line in _experiment(experiment)],
        brief=True,
    )


def _experiment(experiment: Experiment) -> Iterator[str]:
    """What to run next, and why."""
    command = f": {experiment.command}" if experiment.command else ""
    aim = f", to tell {' from '.join(experiment.separates[:2])}" if len(experiment.separates) > 1 else ""
    yield f"next{aim}{command}"
    yield f"  {experiment.why}"
