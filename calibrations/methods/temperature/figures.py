"""Figures of parameters against temperature."""

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from tumble.calibrations.methods.temperature.loop import TemperatureLoop
from tumble.calibrations.report.drawing import COLOURS, INK, MARKERS, WIDE_IN, styled, to_svg
from tumble.messages import Message

_COLUMNS = 3


@styled
def left_figure(loop: TemperatureLoop) -> Markup:
    """A small panel for each parameter."""
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
    return to_svg(figure, "left", Message("What is left of each parameter against temperature"))
