"""Figures of parameters against temperature."""

import numpy as np

from tumble.calibrations.methods.temperature.loop import ParameterLoop, TemperatureLoop
from tumble.calibrations.report.figure import COLOURS, INK, SHAPES, Axis, Figure, Layer, Line, Marks, Panel, Span
from tumble.messages import Message

_COLUMNS = 3


def left_figure(loop: TemperatureLoop) -> Figure:
    """A small panel for each parameter."""
    count = len(loop.parameters)
    label = f"{loop.runs.temperature_name.removesuffix('_degC')} (°C)"
    return Figure(
        name="left",
        description=Message("What is left of each parameter against temperature"),
        panels=tuple(
            _panel(loop, parameter, label if count - number <= _COLUMNS else "")
            for number, parameter in enumerate(loop.parameters)
        ),
        columns=min(_COLUMNS, count),
        height=150.0,
    )


def _panel(loop: TemperatureLoop, parameter: ParameterLoop, label: str) -> Panel:
    temperature_degc = loop.runs.temperature_degc
    values = loop.runs.parameters[parameter.name]
    cubic = np.polynomial.Polynomial.fit(temperature_degc, values, parameter.polynomials[-1].power)
    layers: list[Layer] = [Span(low=0.0, high=0.0, colour=INK, opacity=1.0)]
    for number, left in enumerate((values - cubic(temperature_degc), parameter.residual)):
        layers += [
            Line(x=temperature_degc, y=left, colour=COLOURS[number], width=0.7),
            Marks(x=temperature_degc, y=left, colour=COLOURS[number], shape=SHAPES[2 * number]),
        ]
    return Panel(layers=tuple(layers), title=parameter.name, x=Axis(label=label))
