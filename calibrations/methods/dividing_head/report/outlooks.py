"""Plots of what a proposed experiment would show: by how much rivals differ in it, beside the noise of a dwell."""

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.report.drawing import BAND, COLOURS, HALF_IN, INK, MARKERS, MICRO, sheet, styled, to_svg
from tumble.calibrations.tracing.separation import Difference, Outlook
from tumble.messages import Message

_MILLI_FROM_V = 1e-3
"""Differences from here on stand in millivolts."""
_NEXT_DEG = 15.0
"""Dwells further apart on the head are not joined by a line."""


@styled
def outlook_figure(outlook: Outlook, name: str) -> Markup:
    """What each rival could not follow of the rows of a probe, against the head angle; the band is two dwells wide."""
    probed = outlook.probed
    largest_v = max(float(np.abs(each.left_v[probed]).max()) for each in outlook.differences)
    unit, per_v = ("mV", 1e3) if largest_v >= _MILLI_FROM_V else ("µV", MICRO)
    figure, (panel,) = sheet(HALF_IN + 1.5, 2.8)
    panel.axhspan(-2 * outlook.dwell_v * per_v, 2 * outlook.dwell_v * per_v, color=BAND, alpha=0.18, linewidth=0)
    panel.axhline(0.0, color=INK, linewidth=0.7)
    for number, each in enumerate(outlook.differences):
        panel.plot(
            *_broken(_head_angle_deg(outlook)[probed], each.left_v[probed] * per_v),
            marker=MARKERS[number % len(MARKERS)],
            color=COLOURS[number % len(COLOURS)],
            markersize=2.5,
            markeredgewidth=0,
            linewidth=0.7,
            label=_described(each),
        )
    panel.set_xlabel(Message("head angle as reported (°)"))
    panel.set_ylabel(Message("not followed ({unit})", unit=unit))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    described = Message.joined(", ", [_described(each) for each in outlook.differences])
    title = Message("What the experiment would show against head angle: {described}", described=described)
    return to_svg(figure, name, title)


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
