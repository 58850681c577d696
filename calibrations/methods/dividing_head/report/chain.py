"""The part of the report on how rivals were distinguished: what was run, what it decided, the error then."""

from collections.abc import Iterator

import numpy as np

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.report.figure import COLOURS, SHAPES, Axis, Figure, Layer, Line, Marks, Panel, Span
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.link import Link
from tumble.calibrations.tracing.penalties import CLOSE
from tumble.calibrations.tracing.stage import Stage
from tumble.messages import Message

_LEAST = 0.7
"""Standard deviations. Smaller distances are drawn here: the axis is logarithmic."""


def chain_sections(chain: Chain[Loop]) -> Iterator[Section]:
    """Every experiment with its decision, a plot of the explanations, and why it ended."""
    if chain.links:
        yield Section(
            title=Message("How the rivals were distinguished"),
            caption=Message(
                "Every experiment that was run, in its order. The held-out error is that of the declared model and of "
                "the model with what was found, on everything measured by then; of the first measurement alone it was "
                "{error}. The difference, in standard deviations, is that of the nearest explanation that is "
                "distinguished.",
                error=_error(chain.first),
            ),
            headings=(
                Message("It could be"),
                Message("Experiment"),
                Message("Minutes"),
                Message("Expected difference"),
                Message("Realised"),
                Message("Decides"),
                Message("Held-out error"),
            ),
            rows=[_step(link) for link in chain.links],
        )
        yield Section(
            title="",
            figure=lambda: explanations_figure(chain),
            caption=Message(
                "How far each explanation lies behind the best after each experiment, on a logarithmic scale. In the "
                "band the two are not distinguishable."
            ),
        )
    yield Section(title="", lines=[chain.why] if chain.why else ())


def _step(link: Link[Loop]) -> tuple[str, ...]:
    return (
        series(link.rivals_before, "or"),
        link.experiment.programme,
        f"{link.stand_time_s / 60:.0f}",
        _deviations(link.experiment.separation),
        Message("none") if link.realised is None else _deviations(link.realised),
        link.decision,
        _error(link.after),
    )


def _deviations(difference: float) -> str:
    """In standard deviations, of a difference in -2 ln L."""
    return f"{max(difference, 0.0) ** 0.5:.1f}"


def _error(stage: Stage[Loop]) -> str:
    """Held-out error of the declared model and of the augmented one, on everything measured by then."""
    errors = (stage.loop.declared.held_out_rms_v, stage.loop.augmented.held_out_rms_v)
    return Message.joined(" → ", (Message("none") if error is None else format_number(error, "V") for error in errors))


def explanations_figure(chain: Chain[Loop]) -> Figure:
    """How far each explanation lies behind the best after each measurement; the band holds those that remain."""
    names = list(dict.fromkeys(name for stage in chain.stages for names in stage.disputed for name in names))
    layers: list[Layer] = [Span(low=_LEAST, high=CLOSE**0.5)]
    for number, name in enumerate(names):
        behind = np.array([stage.behind.get(name, np.nan) for stage in chain.stages])
        x, y = np.arange(float(len(behind))), np.maximum(np.sqrt(np.maximum(behind, 0.0)), _LEAST)
        colour, shape = COLOURS[number % len(COLOURS)], SHAPES[number % len(SHAPES)]
        layers += [
            Line(x=x, y=y, colour=colour, width=1.0),
            Marks(x=x, y=y, colour=colour, shape=shape, size=4.0, label=name),
        ]
    return Figure(
        name="explanations",
        description=Message("Explanations after each experiment: {names}", names=Message.joined(", ", names)),
        panels=(
            Panel(
                layers=tuple(layers),
                x=Axis(label=Message("experiments run"), whole=True),
                y=Axis(label=Message("behind the best (standard deviations)"), logarithmic=True),
            ),
        ),
        width=560.0,
    )
