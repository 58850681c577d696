"""The page on parameters against temperature: what a cubic leaves, causes, what is shared, what cannot be known."""

from collections.abc import Iterator, Sequence

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.methods.dividing_head.loop.sentences import findings
from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop
from tumble.calibrations.methods.temperature.shared import shared_sentence
from tumble.calibrations.report.drawing import COLOURS, INK, MARKERS, WIDE_IN, styled, to_svg
from tumble.calibrations.report.tables_page import Part, page

_COLUMNS = 3


def render_temperature(name: str, loop: TemperatureLoop) -> str:
    """The whole page."""
    return page("Parameters against temperature", name, list(_parts(loop)))


def _parts(loop: TemperatureLoop) -> Iterator[Part]:
    word = loop.parameters[0].polynomials[-1].words
    yield Part(
        title="What is left",
        figure=left_figure(loop),
        caption=f"What a {word} leaves (circles) and what is left with what was found (triangles) against temperature.",
    )
    yield Part(
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
    )
    yield Part(
        title="To what it was traced",
        headings=("Parameter", "Effect", "Could also be", "Coefficients", "p"),
        rows=[row for parameter in loop.parameters for row in _found(parameter)],
    )
    yield Part(title="What parameters share", lines=[shared_sentence(cause) for cause in loop.shared])
    yield Part(title="What these runs cannot tell", lines=loop.unknowable)


def _row(parameter: ParameterLoop) -> Sequence[str]:
    cubic = parameter.polynomials[-1]
    errors = (parameter.polynomials[0].held_out_rms, cubic.held_out_rms, parameter.augmented.held_out_rms)
    numbers = (*errors, cubic.standard_deviation)
    return (parameter.name, *("none" if each is None else format_number(each, parameter.unit) for each in numbers))


def _found(parameter: ParameterLoop) -> Iterator[Sequence[str]]:
    for each in findings(parameter.effects):
        yield parameter.name, each.name, each.also_possible or "told apart", each.coefficients, each.p_value


@styled
def left_figure(loop: TemperatureLoop) -> Markup:
    """A small panel for each parameter."""
    from matplotlib.figure import Figure

    rows = -(-len(loop.parameters) // _COLUMNS)
    figure = Figure(figsize=(WIDE_IN, 1.7 * rows), layout="constrained")
    panels = figure.subplots(rows, _COLUMNS, squeeze=False, sharex=True).flat
    temperature_degc = loop.runs.temperature_degc
    for panel, parameter in zip(panels, loop.parameters, strict=False):
        values = loop.runs.parameters[parameter.name]
        cubic = np.polynomial.Polynomial.fit(temperature_degc, values, parameter.polynomials[-1].power)
        panel.axhline(0.0, color=INK, linewidth=0.6)
        for number, left in enumerate((values - cubic(temperature_degc), parameter.residual)):
            marker = MARKERS[2 * number]
            panel.plot(temperature_degc, left, marker=marker, markersize=3, linewidth=0.7, color=COLOURS[number])
        panel.set_title(parameter.name, fontsize=8)
    for panel in list(panels)[len(loop.parameters) :]:
        panel.set_visible(False)
    figure.supxlabel(f"{loop.runs.temperature_name.removesuffix('_degC')} (°C)", fontsize=8)
    return to_svg(figure, "left", "What is left of each parameter against temperature")
