"""Figures of a head that is measured against a reference."""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.report.figure import COLOURS, INK, SHAPES, Axis, Figure, Layer, Marks, Panel, Span
from tumble.messages import Message


def residual_figure(loop: ReferenceLoop, residual_deg: FloatArray) -> Figure:
    """A residual, shape (dwells,), against the angle of the head, each way and rests apart."""
    return Figure(
        name="residual-before",
        description=Message("Residual against head angle, before what was found is taken off"),
        panels=(_panel(loop, residual_deg),),
    )


def before_and_after(loop: ReferenceLoop) -> Figure:
    """What a constant offset leaves, and what is left with what was found."""
    residuals = {
        Message("Constant offset"): loop.explanation.before_deg,
        Message("With what was found"): loop.explanation.residual_deg,
    }
    return Figure(
        name="residual",
        description=Message("Residual against head angle, before and after what was found is taken off"),
        panels=tuple(_panel(loop, residual_deg, title) for title, residual_deg in residuals.items()),
        columns=2,
        height=220.0,
    )


def _panel(loop: ReferenceLoop, residual_deg: FloatArray, title: str = "") -> Panel:
    scene = loop.explanation.scene
    speed = scene.velocity_deg_s
    still = np.zeros(scene.rows, dtype=bool) if speed is None or not speed.any() else np.abs(speed) < 1e-3
    kinds = {
        Message("forward"): (scene.direction > 0) & ~still,
        Message("backward"): (scene.direction < 0) & ~still,
        Message("at rest"): still | (scene.direction == 0),
    }
    layers: list[Layer] = [Span(low=0.0, high=0.0, colour=INK, opacity=1.0)]
    layers += [
        Marks(
            x=scene.angle_deg[chosen],
            y=residual_deg[chosen],
            colour=COLOURS[number],
            shape=SHAPES[number],
            size=2.5,
            label=label,
        )
        for number, (label, chosen) in enumerate(kinds.items())
        if chosen.any()
    ]
    x, y = Axis(label=Message("head angle as reported (°)")), Axis(label=Message("reference - head (°)"))
    return Panel(layers=tuple(layers), x=x, y=y, title=title)
