"""The Allan deviation drawn."""

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from tumble.calibrations.allan.result import AllanResult, OutputNoise
from tumble.calibrations.report.drawing import COLOURS, MARKERS, WIDE_IN, styled, to_svg
from tumble.messages import Message


@styled
def allan_figure(result: AllanResult) -> Markup:
    """Deviations of all outputs with their intervals, the fitted noise and the best averaging times."""
    figure = Figure(figsize=(WIDE_IN, 3.6), layout="constrained")
    axes = figure.subplots()
    for number, (name, output) in enumerate(result.outputs.items()):
        _draw(axes, number % len(COLOURS), name, output)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_xlabel(Message("averaging time τ (s)"))
    units = dict.fromkeys(output.unit for output in result.outputs.values())
    axes.set_ylabel(Message("Allan deviation ({unit})", unit=", ".join(units)))
    axes.legend()
    return to_svg(figure, "allan", Message("Allan deviation over averaging time"))


def _draw(axes: Axes, number: int, name: str, output: OutputNoise) -> None:
    """One output; where its minimum may lie is a bar at its height."""
    colour, best = COLOURS[number], output.best
    tau_s = np.array([each.tau_s for each in output.deviations])
    value, low, high = np.array([(each.value, each.low, each.high) for each in output.deviations]).T
    axes.plot(best.curve_tau_s, best.curve, color=colour, linewidth=0.8, alpha=0.6)
    axes.errorbar(
        tau_s,
        value,
        (value - low, high - value),
        fmt=MARKERS[number],
        markersize=3,
        linewidth=0.8,
        color=colour,
        label=name,
    )
    axes.plot(best.curve_tau_s, output.model.deviation(best.curve_tau_s), "--", color=colour, linewidth=0.8)
    axes.plot([best.low_s, best.high_s], [best.deviation] * 2, color=colour, linewidth=4, alpha=0.3)
