"""The Allan deviation drawn."""

from collections.abc import Iterator

import numpy as np

from tumble.calibrations.allan.result import AllanResult, OutputNoise
from tumble.calibrations.report.figure import COLOURS, SHAPES, Axis, Figure, Layer, Line, Marks, Panel
from tumble.messages import Message


def allan_figure(result: AllanResult) -> Figure:
    """Deviations of all outputs with their intervals, the fitted noise and the best averaging times."""
    layers = [
        layer
        for number, (name, output) in enumerate(result.outputs.items())
        for layer in _layers(COLOURS[number % len(COLOURS)], number, name, output)
    ]
    units = dict.fromkeys(output.unit for output in result.outputs.values())
    x = Axis(label=Message("averaging time τ (s)"), logarithmic=True)
    y = Axis(label=Message("Allan deviation ({unit})", unit=", ".join(units)), logarithmic=True)
    return Figure(
        name="allan",
        description=Message("Allan deviation over averaging time"),
        panels=(Panel(layers=tuple(layers), x=x, y=y),),
        height=290.0,
    )


def _layers(colour: str, number: int, name: str, output: OutputNoise) -> Iterator[Layer]:
    """One output; where its minimum may lie is a bar at its height."""
    best = output.best
    tau_s = np.array([each.tau_s for each in output.deviations])
    value, low, high = np.array([(each.value, each.low, each.high) for each in output.deviations]).T
    yield Line(x=best.curve_tau_s, y=best.curve, colour=colour, width=0.6)
    yield Marks(x=tau_s, y=value, y_ends=(low, high), colour=colour, shape=SHAPES[number % len(SHAPES)], label=name)
    yield Line(x=best.curve_tau_s, y=output.model.deviation(best.curve_tau_s), colour=colour, width=0.8, dashed=True)
    yield Line(x=np.array([best.low_s, best.high_s]), y=np.full(2, best.deviation), colour=colour, width=3.0)
