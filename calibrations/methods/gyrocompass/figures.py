"""Figures of a gyrocompass: heading circle, rate against azimuth with the fit and what it leaves, drift over time."""

from typing import Final

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, DRIFT, direction
from tumble.calibrations.report.drawing import COLOURS, INK, MARKERS, PALE, WIDE_IN, styled, to_svg
from tumble.messages import Message

_AROUND_DEG: Final = np.arange(0.0, 361.0, 3.0)
_MINUTES: Final = 60.0


@styled
def heading_circle(loop: GyrocompassLoop) -> Markup:
    """The platform's axis at pickoff angle 0 on the compass, north up, with the interval that holds it."""
    figure = Figure(figsize=(3.4, 3.4), layout="constrained")
    axes = figure.add_subplot(projection="polar")
    assert isinstance(axes, PolarAxes), "it was asked for"
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(1)
    axes.set_xticks(np.deg2rad([0.0, 90.0, 180.0, 270.0]), ["N", "W", "S", "E"])
    axes.set_yticks([])
    axes.set_ylim(0.0, 1.05)
    alpha0 = loop.augmented.parameters["alpha0"]
    headings_deg = loop.declared_fit.headings_deg if alpha0.value is None else (alpha0.value,)
    given_deg = tuple(alpha0.given.values()) or headings_deg
    for number, each_deg in enumerate(given_deg):
        axes.plot(np.deg2rad([each_deg, each_deg]), [0.0, 1.0], color=COLOURS[number % len(COLOURS)], linewidth=1.6)
    if alpha0.interval_95 is not None:
        span = np.deg2rad(np.linspace(*alpha0.interval_95, 50))
        axes.fill_between(span, 0.0, 1.0, color=COLOURS[0], alpha=0.25)
    for azimuth_deg in np.unique(loop.observations.azimuth_deg).tolist():
        at = np.deg2rad(given_deg[0] + azimuth_deg)
        axes.plot([at], [1.0], MARKERS[0], color=PALE, markersize=4)
    return to_svg(figure, "heading", Message("Heading circle: the axis at pickoff angle 0, and the positions"))


@styled
def rate_figure(loop: GyrocompassLoop) -> Markup:
    """Rate of each dwell against the pickoff angle with the fit, and what is left of it before and after."""
    figure = Figure(figsize=(WIDE_IN, 4.2), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    rows = loop.observations
    azimuth_deg = rows.azimuth_deg % 360.0
    for base in range(loop.explained.table.bases):
        its = rows.bases == base
        colour = COLOURS[base % len(COLOURS)]
        above.plot(azimuth_deg[its], rows.rate_deg_h[its], MARKERS[0], color=colour, markersize=3, linestyle="none")
        above.plot(_AROUND_DEG, _curve(loop, int(np.argmax(its))), color=colour, linewidth=0.9)
    above.set_ylabel(Message("rate (°/h)"))
    below.axhline(0.0, color=INK, linewidth=0.6)
    for number, left in enumerate((left_before(loop), left_after(loop))):
        below.plot(azimuth_deg, left, MARKERS[2 * number], color=COLOURS[number], markersize=3, linestyle="none")
    below.set_ylabel(Message("rate less fit (°/h)"))
    below.set_xlabel(Message("pickoff angle (°)"))
    for axes in (above, below):
        axes.set_xticks(np.arange(0.0, 361.0, 45.0))
    return to_svg(figure, "rate", Message("Rate against the pickoff angle with the fit, and what is left of it"))


@styled
def drift_figure(loop: GyrocompassLoop) -> Markup:
    """The drift of each dwell over time: the rate less the earth rate."""
    figure = Figure(figsize=(WIDE_IN, 2.2), layout="constrained")
    axes = figure.subplots()
    rows = loop.observations
    hours = loop.explained.table.scene.dwell_hours
    along = np.arange(len(rows), dtype=float) if hours is None else _MINUTES * hours
    axes.axhline(float(loop.best.theta[DRIFT]), color=INK, linewidth=0.6)
    axes.plot(along, rows.rate_deg_h - earth_deg_h(loop), MARKERS[0], color=COLOURS[0], markersize=3, linestyle="none")
    axes.set_xlabel(Message("dwell") if hours is None else Message("time (min)"))
    axes.set_ylabel(Message("drift (°/h)"))
    return to_svg(figure, "drift", Message("Drift of each dwell over time"))


def earth_deg_h(loop: GyrocompassLoop) -> FloatArray:
    """Earth rate of each dwell by the fit with what was found, shape (dwells,)."""
    scene = loop.explained.table.scene
    shown = heading_functions(scene.delta_rad, loop.observations.latitude_deg, scene.lean)
    return np.asarray(shown @ direction(float(loop.best.theta[ALPHA0])))


def left_before(loop: GyrocompassLoop) -> FloatArray:
    """Rates less heading and drift without what was found, shape (dwells,)."""
    table = loop.declared_fit.table
    fitted = table.declared @ table.model.coefficients(loop.before.theta)
    return np.asarray((table.output - fitted)[table.rates])


def left_after(loop: GyrocompassLoop) -> FloatArray:
    """The same less what was found."""
    return np.asarray(loop.best.residual[loop.explained.table.rates])


def _curve(loop: GyrocompassLoop, row: int) -> FloatArray:
    """The fitted rate round the circle, on the base and at the latitude of a row."""
    lean, count = loop.explained.table.scene.lean, len(_AROUND_DEG)
    its = Lean(cosine=np.full(count, lean.cosine[row]), sine=np.full(count, lean.sine[row]))
    latitude_deg = np.full(count, loop.observations.latitude_deg[row])
    shown = heading_functions(np.deg2rad(_AROUND_DEG), latitude_deg, its)
    return np.asarray(shown @ direction(float(loop.best.theta[ALPHA0])) + loop.best.theta[DRIFT])
