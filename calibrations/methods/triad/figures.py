"""Figures of a triad."""

from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.methods.triad.mismatch import dwell_mismatch, position_mismatch
from tumble.calibrations.methods.triad.model import NAMES
from tumble.calibrations.report.correlation import correlation_picture
from tumble.calibrations.report.figure import COLOURS, INK, SHAPES, Axis, Figure, Marks, Panel, Shades, Span
from tumble.messages import Message

_QUARTERS: Final = tuple(np.arange(-180.0, 181.0, 90.0).tolist())
_TURN: Final = (-200.0, 200.0)
_MISMATCH: Final = "|a| - 1 (″)"


def mismatch_figure(loop: TriadLoop) -> Figure:
    """|a| - 1 of each dwell in the order of the positions, before and after."""
    order = np.argsort(loop.observations.positions, kind="stable")
    marks = tuple(
        Marks(x=np.arange(len(order), dtype=float), y=mismatch[order], colour=COLOURS[number], shape=SHAPES[2 * number])
        for number, mismatch in enumerate(dwell_mismatch(loop))
    )
    panel = Panel(
        layers=(Span(low=0.0, high=0.0, colour=INK, opacity=1.0), *marks),
        x=Axis(label=Message("dwell, by position"), whole=True),
        y=Axis(label=_MISMATCH),
    )
    return Figure(
        name="mismatch", description=Message("Mismatch of each dwell before and after"), panels=(panel,), height=180.0
    )


def mismatch_map(loop: TriadLoop) -> Figure:
    """Where both axes stood, each position in the colour of its mean mismatch, before and after in one scale."""
    found = position_mismatch(loop)
    most = max(float(np.abs(each).max()) for each in (found.before_arcsec, found.after_arcsec)) or 1.0
    inner, outer = _within_turn(found.inner_deg), _within_turn(found.outer_deg)
    titled = {Message("declared model"): found.before_arcsec}
    if not np.allclose(found.before_arcsec, found.after_arcsec, rtol=0.0, atol=1e-6):
        titled[Message("with what was found")] = found.after_arcsec
    panels = tuple(
        Panel(
            layers=(Shades(x=inner, y=outer, values=mismatch, most=most),),
            title=title,
            x=Axis(label=Message("inner angle (°)"), ticks=_QUARTERS, ends=_TURN),
            y=Axis(label=Message("outer angle (°)"), ticks=_QUARTERS, ends=_TURN),
        )
        for title, mismatch in titled.items()
    )
    return Figure(
        name="mismatch-map",
        description=Message("Mismatch over the angles of both axes before and after"),
        panels=panels,
        columns=2,
        height=270.0,
        scale=(_MISMATCH, most),
    )


def correlation_figure(loop: TriadLoop) -> Figure:
    """Correlation of the parameters that the positions tell, with what was found in the model."""
    fit = loop.best
    told = np.flatnonzero(fit.identified)
    covariance = fit.parameter_covariance[np.ix_(told, told)]
    deviation = np.sqrt(np.diag(covariance))
    return correlation_picture([NAMES[index] for index in told], covariance / np.outer(deviation, deviation))


def _within_turn(angle_deg: FloatArray) -> FloatArray:
    """Above -180° up to 180°."""
    return np.asarray(180.0 - (180.0 - angle_deg) % 360.0)
