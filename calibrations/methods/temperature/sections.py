"""What is shown of parameters against temperature."""

from collections.abc import Iterator, Sequence

from markupsafe import Markup

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop
from tumble.calibrations.methods.temperature.shared import shared_sentence
from tumble.calibrations.tracing.sentences import findings


def sections(loop: TemperatureLoop) -> Iterator[Section]:
    """What is shown of a table of runs, the answer first."""
    word = loop.parameters[0].polynomials[-1].words
    few = loop.parameters[0].explained.table.not_traced
    yield Section(
        title="To what it was traced",
        lines=(f"Nothing is looked for: {few}.",) if few else (),
        headings=("Parameter", "Effect", "Could also be", "Coefficients", "p"),
        rows=[row for parameter in loop.parameters for row in _found(parameter)],
        brief=True,
    )
    yield Section(
        title="Before and after",
        lines=("Errors are of runs at a temperature that was left out and predicted from the others, r.m.s.",),
        headings=(
            "Parameter",
            "Constant",
            word.capitalize(),
            "With what was found",
            f"{word.capitalize()} leaves, standard deviation",
        ),
        rows=[_row(parameter) for parameter in loop.parameters],
        brief=True,
    )
    yield Section(
        title="What is left",
        figure=lambda: left_figure(loop),
        caption=f"What a {word} leaves (circles) and what is left with what was found (triangles) against temperature.",
    )
    yield Section(title="What parameters share", lines=[shared_sentence(cause) for cause in loop.shared], brief=True)
    yield Section(title="What these runs cannot tell", lines=loop.unknowable)


def _row(parameter: ParameterLoop) -> Sequence[str]:
    cubic = parameter.polynomials[-1]
    errors = (parameter.polynomials[0].held_out_rms, cubic.held_out_rms, parameter.augmented.held_out_rms)
    numbers = (*errors, cubic.standard_deviation)
    return (parameter.name, *("none" if each is None else format_number(each, parameter.unit) for each in numbers))


def _found(parameter: ParameterLoop) -> Iterator[Sequence[str]]:
    if parameter.explained.table.not_traced and not parameter.effects:
        yield parameter.name, "not looked for", "", "", ""
    for each in findings(parameter.effects):
        yield parameter.name, each.name, each.also_possible or "told apart", each.coefficients, each.p_value


def left_figure(loop: TemperatureLoop) -> Markup:
    """What is left of each parameter, a small panel for each."""
    from tumble.calibrations.methods.temperature import figures  # matplotlib takes half a second

    return figures.left_figure(loop)
