"""What is shown of parameters against temperature."""

from collections.abc import Iterator, Sequence

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.temperature.figures import left_figure
from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop
from tumble.calibrations.methods.temperature.shared import shared_sentence
from tumble.calibrations.tracing.sentences import findings, nothing_looked_for
from tumble.messages import Message


def sections(loop: TemperatureLoop) -> Iterator[Section]:
    """What is shown of a table of runs, the answer first."""
    highest = loop.parameters[0].polynomials[-1]
    few = loop.parameters[0].explained.table.not_traced
    yield Section(
        title=Message("To what it was traced"),
        lines=(nothing_looked_for(few),) if few else (),
        headings=(
            Message("Parameter"),
            Message("Effect"),
            Message("Could also be"),
            Message("Coefficients"),
            "p",
        ),
        rows=[row for parameter in loop.parameters for row in _found(parameter)],
        brief=True,
    )
    yield Section(
        title=Message("Before and after"),
        lines=(Message("Errors are of runs at a temperature that was left out and predicted from the others, r.m.s."),),
        headings=(
            Message("Parameter"),
            Message("Constant"),
            Message.capitalised(highest.words),
            Message("With what was found"),
            Message.capitalised(Message("{polynomial} leaves, standard deviation", polynomial=highest.words)),
        ),
        rows=[_row(parameter) for parameter in loop.parameters],
        brief=True,
    )
    yield Section(
        title=Message("What is left"),
        figure=lambda: left_figure(loop),
        caption=Message(
            "What a {polynomial} leaves (circles) and what is left with what was found (triangles) against "
            "temperature.",
            polynomial=highest.words,
        ),
    )
    shared = [shared_sentence(cause) for cause in loop.shared]
    yield Section(title=Message("What parameters share"), lines=shared, brief=True)
    yield Section(title=Message("What these runs cannot tell"), lines=loop.limits)


def _row(parameter: ParameterLoop) -> Sequence[str]:
    cubic = parameter.polynomials[-1]
    errors = (parameter.polynomials[0].held_out_rms, cubic.held_out_rms, parameter.augmented.held_out_rms)
    numbers = (*errors, cubic.standard_deviation)
    return (
        parameter.name,
        *(Message("none") if each is None else format_number(each, parameter.unit) for each in numbers),
    )


def _found(parameter: ParameterLoop) -> Iterator[Sequence[str]]:
    if parameter.explained.table.not_traced and not parameter.effects:
        yield parameter.name, Message("not looked for"), "", "", ""
    for each in findings(parameter.effects):
        also_possible = each.also_possible or Message("distinguished")
        yield parameter.name, each.name, also_possible, each.coefficients, each.p_value
