"""Figures of a head that is measured against a reference."""

from typing import Final, Literal

import numpy as np
from markupsafe import Markup

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.report.drawing import COLOURS, INK, WIDE_IN, sheet, styled, to_svg
from tumble.messages import Message

_DESCRIPTIONS: Final = {
    "before": Message("Residual against head angle, before what was found is taken off"),
    "after": Message("Residual against head angle, after what was found is taken off"),
}


@styled
def residual_figure(loop: ReferenceLoop, residual_deg: FloatArray, name: Literal["before", "after"]) -> Markup:
    """A residual, shape (dwells,), against the angle of the head, each way and rests apart."""
    scene = loop.explanation.scene
    speed = scene.velocity_deg_s
    still = np.zeros(scene.rows, dtype=bool) if speed is None or not speed.any() else np.abs(speed) < 1e-3
    kinds = {
        Message("forward"): (scene.direction > 0) & ~still,
        Message("backward"): (scene.direction < 0) & ~still,
        Message("at rest"): still | (scene.direction == 0),
    }
    figure, (panel,) = sheet(WIDE_IN, 2.6)
    panel.axhline(0.0, color=INK, linewidth=0.7)
    for number, (label, chosen) in enumerate(kinds.items()):
        if chosen.any():
            marker = "o^s"[number]
            panel.plot(
                *(scene.angle_deg[chosen], residual_deg[chosen]), linestyle="", marker=marker, markersize=2.5,
                markeredgewidth=0, color=COLOURS[number], label=label,
            )  # fmt: skip
    panel.set_xlabel(Message("head angle as reported (°)"))
    panel.set_ylabel(Message("reference - head (°)"))
    panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return to_svg(figure, f"residual-{name}", _DESCRIPTIONS[name])
