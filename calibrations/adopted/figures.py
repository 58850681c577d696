"""The course of an adopted effect as a figure."""

import numpy as np

from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.report.figure import INK, Area, Axis, Figure, Layer, Line, Marks, Panel, Span
from tumble.messages import Message


def course_figure(effect: AdoptedEffect, label: str) -> Figure:
    """Its values with the band of their expanded uncertainty; at places in space, or of labels, one after the other."""
    curve = effect.curve
    places = curve.knots.places
    across = places[:, 0] if places.shape[1] == 1 else np.arange(len(curve.values), dtype=float)
    expanded = 2.0 * curve.standard_uncertainty
    layers: list[Layer] = [
        Span(low=0.0, high=0.0, colour=INK, opacity=1.0),
        Area(x=across, low=curve.values - expanded, high=curve.values + expanded),
        Marks(x=across, y=curve.values, size=2.5),
    ]
    if curve.knots.on_a_line:
        layers.append(Line(x=across, y=curve.values))
    return Figure(
        name=f"course-{effect.name}",
        description=Message("Course of {name} over its variable", name=effect.name),
        panels=(Panel(layers=tuple(layers), x=Axis(label=label), y=Axis(label=effect.channel_unit)),),
    )
