"""What is shown of a closed loop."""

from collections.abc import Iterator

from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.sentences import (
    comparisons,
    dependence,
    findings_of,
    headline,
    not_identifiable,
)
from tumble.calibrations.tracing.experiments import Experiment
from tumble.messages import Message


def sections(loop: Loop) -> Iterator[Section]:
    """What was found, the models before and after, what is not identifiable any more, and what to measure next."""
    yield Section(
        title=Message("What was found"),
        lines=(headline(loop),),
        headings=(
            Message("effect"),
            Message("or"),
            Message("belongs to"),
            Message("coefficients (standard uncertainty)"),
            "p",
        ),
        rows=[
            (each.name, each.also_possible, each.belongs_to, each.coefficients, each.p_value)
            for each in findings_of(loop)
        ],
        brief=True,
    )
    yield Section(
        title=Message("Before and after"),
        headings=("", Message("declared model"), Message("with what was found"), Message("change")),
        rows=[(line.name, line.declared, line.augmented, line.change) for line in comparisons(loop)],
        brief=True,
    )
    yield Section(
        title=Message("What is not identifiable"),
        lines=[
            *(
                Message("- {name} is not identifiable: {reason}", name=name, reason=reason)
                for name, reason in not_identifiable(loop)
            ),
            *(Message("- {dependence}", dependence=said) for said in [dependence(loop)] if said),
        ],
        brief=True,
    )
    yield Section(
        title=Message("What to measure next"),
        lines=[line for experiment in loop.next_experiment for line in _experiment(experiment)],
        brief=True,
    )


def _experiment(experiment: Experiment) -> Iterator[str]:
    """What to run next, and why."""
    first, *others = experiment.separates
    aim = Message("next, to tell {effect} from {other}", effect=first, other=others[0]) if others else Message("next")
    yield Message("{aim}: {command}", aim=aim, command=experiment.command) if experiment.command else aim
    yield Message("  {why}", why=experiment.why)
