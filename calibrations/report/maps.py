"""Error of a head over a turn, drawn."""

import numpy as np

from tumble.calibrations.report.figure import COLOURS, INK, Area, Axis, Figure, Layer, Line, Panel, Span
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.messages import Message

_ARCSEC = 3600.0


def head_map_figure(head_map: HeadMap) -> Figure:
    """True minus reported angle over a turn, after moves in each direction where that differs, with two u."""
    directions = (
        {1: Message("after moves in + direction"), -1: Message("after moves in - direction")}
        if head_map.backlash_deg
        else {1: ""}
    )
    layers: list[Layer] = [Span(low=0.0, high=0.0, colour=INK, opacity=1.0)]
    for colour, (direction, label) in zip(COLOURS, directions.items(), strict=False):
        curve = head_map.curve(direction)
        error, twice = curve.error_deg * _ARCSEC, 2 * curve.standard_uncertainty_deg * _ARCSEC
        layers += [
            Area(x=curve.angle_deg, low=error - twice, high=error + twice),
            Line(x=curve.angle_deg, y=error, colour=colour, label=label),
        ]
    x = Axis(label=Message("head angle as reported (°)"), ticks=np.arange(0.0, 361.0, 45.0).tolist())
    return Figure(
        name="head-map",
        description=Message("Error of the head over a turn with its uncertainty"),
        panels=(Panel(layers=tuple(layers), x=x, y=Axis(label=Message("true - reported (″)"))),),
        height=210.0,
    )
