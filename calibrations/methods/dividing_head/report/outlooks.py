"""Plots of what a proposed experiment would show: by how much rivals differ in it, beside the noise of a dwell."""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.report.figure import (
    COLOURS,
    MICRO,
    SHAPES,
    Axis,
    Figure,
    Layer,
    Line,
    Marks,
    Panel,
    residual_line,
)
from tumble.calibrations.tracing.separation import Difference, Outlook
from tumble.messages import Message

_MILLI_FROM_V = 1e-3
"""Differences from here on stand in millivolts."""
_NEXT_DEG = 15.0
"""Dwells further apart on the head are not joined by a line."""


def outlook_figure(outlook: Outlook, name: str) -> Figure:
    """What each rival could not follow of the rows of a probe, against the head angle; the band is two dwells wide."""
    probed = outlook.probed
    largest_v = max(float(np.abs(each.left_v[probed]).max()) for each in outlook.differences)
    unit, per_v = ("mV", 1e3) if largest_v >= _MILLI_FROM_V else ("µV", MICRO)
    layers: list[Layer] = [*residual_line(2 * outlook.dwell_v * per_v)]
    for number, each in enumerate(outlook.differences):
        angle_deg, left = _broken(_head_angle_deg(outlook)[probed], each.left_v[probed] * per_v)
        colour, shape = COLOURS[number % len(COLOURS)], SHAPES[number % len(SHAPES)]
        layers += [
            Line(x=angle_deg, y=left, colour=colour, width=0.7),
            Marks(x=angle_deg, y=left, colour=colour, shape=shape, size=2.5, label=_described(each)),
        ]
    described = Message.joined(", ", [_described(each) for each in outlook.differences])
    return Figure(
        name=name,
        description=Message("What the experiment would show against head angle: {described}", described=described),
        panels=(
            Panel(
                layers=tuple(layers),
                x=Axis(label=Message("head angle as reported (°)")),
                y=Axis(label=Message("not followed ({unit})", unit=unit)),
            ),
        ),
    )


def _described(difference: Difference) -> Message:
    return Message("{other} if {true} is true", other=difference.other, true=difference.true)


def _broken(angle_deg: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A line that stops where the next dwell is not near."""
    jumps = np.flatnonzero(np.abs(np.diff(angle_deg)) > _NEXT_DEG) + 1
    return np.insert(angle_deg, jumps, np.nan), np.insert(values, jumps, np.nan)


def _head_angle_deg(outlook: Outlook) -> FloatArray:
    """Head angle of every row of an accelerometer's experiment."""
    assert isinstance(outlook.rows, Observations), "an experiment goes on with the rows of its table"
    return outlook.rows.angle_deg
