"""The chapter on the closed loop: what the declared model left, to what it was traced, and what that changes."""

from collections.abc import Iterator, Sequence
from functools import partial

from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.sentences import (
    comparisons,
    findings_of,
    headline,
)
from tumble.calibrations.methods.dividing_head.report.abscissa import Abscissa
from tumble.calibrations.methods.dividing_head.report.chain import chain_sections
from tumble.calibrations.methods.dividing_head.report.outlooks import outlook_figure
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.methods.dividing_head.report.traces import abscissae, trace_figure
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.figure import Figure
from tumble.calibrations.tracing.experiments import Experiment
from tumble.messages import Message


def loop_sections(subject: Subject) -> Iterator[Section]:
    """The effects found, the models before and after, and the residual against what explains it."""
    loop = subject.loop
    if loop is None:
        yield Section(title="", lines=[Message("What the residual comes from was not asked.")])
    else:
        yield _findings(loop)
        if loop.effects or loop.unexplained:
            yield from before_and_after(loop)
            yield _compared(loop)
    if subject.chain is not None:
        yield from chain_sections(subject.chain)
    if loop is not None and (loop.effects or loop.unexplained):
        yield from _experiments(loop.next_experiment)


def _findings(loop: Loop) -> Section:
    return Section(
        title="",
        lines=[headline(loop)],
        caption=Message(
            "Effects of the catalogue that the data shows, in the order of the evidence, with their standard "
            "uncertainties. p is the probability of as much evidence by chance. Beside each stands what would explain "
            "this data as well."
        ),
        headings=(
            Message("Effect"),
            Message("Could also be"),
            Message("Belongs to"),
            Message("Coefficients"),
            "p",
        ),
        rows=[
            (
                each.name,
                each.also_possible or Message("distinguished"),
                each.belongs_to,
                each.coefficients,
                each.p_value,
            )
            for each in findings_of(loop)
        ],
    )


def before_and_after(loop: Loop) -> Iterator[Section]:
    """The residual of both models against everything that an effect depends on: each figure with what it shows."""
    models: dict[str, Calibration] = {
        Message("declared model"): loop.declared,
        Message("with what was found"): loop.augmented,
    }
    for abscissa, seen in abscissae(loop).items():
        figure = trace_figure(models, abscissa)
        if figure is not None:
            yield Section(title="", figure=partial(_same, figure), caption=_caption(abscissa, seen))


def _same(figure: Figure) -> Figure:
    return figure


def _caption(abscissa: Abscissa, seen: Sequence[str]) -> Message:
    sentences = [Message("Where {effects} shows.", effects=series(seen))]
    if abscissa.levels:
        sentences.append(Message("Boxes: quartiles and median; the band is the scatter of one dwell."))
    else:
        sentences.append(
            Message(
                "Grey: single dwells. Coloured: means with twice their standard uncertainty. The band is the scatter "
                "of one dwell."
            )
        )
    if abscissa.as_angle:
        sentences.append(
            Message("The residual is divided by the slope of the output; rows where it is flat are left out.")
        )
    return Message.joined(" ", sentences)


def _compared(loop: Loop) -> Section:
    return Section(
        title="",
        caption=Message(
            "Before and after. The change of a parameter stands also in its standard uncertainties u before: it shows "
            "whether the effect was covered."
        ),
        headings=("", Message("Declared model"), Message("With what was found"), Message("Change")),
        rows=[(line.name, line.declared, line.augmented, line.change) for line in comparisons(loop)],
    )


def _experiments(experiments: Sequence[Experiment]) -> Iterator[Section]:
    """What to measure next, each with what it would show."""
    for number, experiment in enumerate(experiments, start=1):
        lines: list[str] = [Message("{why}.", why=experiment.why)]
        outlook = experiment.outlook
        title = Message("What to measure next") if number == 1 else ""
        if outlook is None:
            yield Section(title=title, lines=lines)
            continue
        figure = outlook_figure(outlook, f"next-{number}")
        yield Section(
            title=title,
            lines=[*lines, experiment.command],
            figure=partial(_same, figure),
            caption=Message(
                "The part of one explanation that the other could not follow in these dwells, fitted to the table and "
                "them. The band is two standard deviations of a dwell on both sides."
            ),
        )
