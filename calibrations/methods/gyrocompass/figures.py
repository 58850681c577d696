"""Figures of a gyrocompass: heading circle, rate against azimuth with the fit and what it leaves, drift over time."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, DRIFT, direction
from tumble.calibrations.report.figure import (
    COLOURS,
    INK,
    PALE,
    SHAPES,
    Axis,
    Figure,
    Layer,
    Line,
    Marks,
    Panel,
    Span,
)
from tumble.messages import Message

_AROUND_DEG: Final = np.arange(0.0, 361.0, 3.0)
_EIGHTHS: Final = tuple(range(0, 361, 45))
_MINUTES: Final = 60.0
_BEYOND: Final = 1.15
"""Of the radius of the compass, so much is drawn."""


def heading_circle(loop: GyrocompassLoop) -> Figure:
    """The platform's axis at pickoff angle 0 on the compass, north up, with the interval that holds it."""
    panel = Panel(
        layers=tuple(_compass(loop)),
        x=Axis(ticks=(-1.0, 1.0), names=(Message("W"), Message("E")), ends=(-_BEYOND, _BEYOND)),
        y=Axis(ticks=(-1.0, 1.0), names=(Message("S"), Message("N")), ends=(-_BEYOND, _BEYOND)),
        equal_units=True,
    )
    return Figure(
        name="heading",
        description=Message("Heading circle: the axis at pickoff angle 0, and the positions"),
        panels=(panel,),
        height=300.0,
        width=326.0,
    )


def _compass(loop: GyrocompassLoop) -> Iterator[Layer]:
    """Circle, interval, axis and positions."""
    alpha0 = loop.augmented.parameters["alpha0"]
    headings_deg = loop.declared_fit.headings_deg if alpha0.value is None else (alpha0.value,)
    given_deg = tuple(alpha0.given.values()) or headings_deg
    if alpha0.interval_95 is not None:
        x, y = _on_compass(np.linspace(*alpha0.interval_95, 50))
        yield Line(x=np.array([0.0, *x, 0.0]), y=np.array([0.0, *y, 0.0]), colour=COLOURS[0], width=0.8)
    x, y = _on_compass(_AROUND_DEG)
    yield Line(x=x, y=y, colour=PALE, width=0.6)
    for number, each_deg in enumerate(given_deg):
        (east,), (north,) = _on_compass(np.array([each_deg]))
        yield Line(x=np.array([0.0, east]), y=np.array([0.0, north]), colour=COLOURS[number % len(COLOURS)], width=1.6)
    x, y = _on_compass(given_deg[0] + np.unique(loop.observations.azimuth_deg))
    yield Marks(x=x, y=y, colour=PALE, size=4.0)


def _on_compass(angle_deg: FloatArray) -> tuple[FloatArray, FloatArray]:
    """East and north of angles that count from north over west."""
    return -np.sin(np.deg2rad(angle_deg)), np.cos(np.deg2rad(angle_deg))


def rate_figure(loop: GyrocompassLoop) -> Figure:
    """Rate of each dwell against the pickoff angle with the fit, and what is left of it before and after."""
    rows = loop.observations
    azimuth_deg = rows.azimuth_deg % 360.0
    above: list[Layer] = []
    for base in range(loop.explained.table.bases):
        its = rows.bases == base
        colour = COLOURS[base % len(COLOURS)]
        above += [
            Marks(x=azimuth_deg[its], y=rows.rate_deg_h[its], colour=colour),
            Line(x=_AROUND_DEG, y=_curve(loop, int(np.argmax(its))), colour=colour, width=0.9),
        ]
    below: list[Layer] = [Span(low=0.0, high=0.0, colour=INK, opacity=1.0)]
    below += [
        Marks(x=azimuth_deg, y=left, colour=COLOURS[number], shape=SHAPES[2 * number])
        for number, left in enumerate((left_before(loop), left_after(loop)))
    ]
    ends = (-10.0, 370.0)
    return Figure(
        name="rate",
        description=Message("Rate against the pickoff angle with the fit, and what is left of it"),
        panels=(
            Panel(layers=tuple(above), x=Axis(ticks=_EIGHTHS, ends=ends), y=Axis(label=Message("rate (°/h)"))),
            Panel(
                layers=tuple(below),
                x=Axis(label=Message("pickoff angle (°)"), ticks=_EIGHTHS, ends=ends),
                y=Axis(label=Message("rate less fit (°/h)")),
            ),
        ),
        height=170.0,
    )


def drift_figure(loop: GyrocompassLoop) -> Figure:
    """The drift of each dwell over time: the rate less the earth rate."""
    rows = loop.observations
    hours = loop.explained.table.scene.dwell_hours
    along = np.arange(len(rows), dtype=float) if hours is None else _MINUTES * hours
    drift = float(loop.best.theta[DRIFT])
    panel = Panel(
        layers=(
            Span(low=drift, high=drift, colour=INK, opacity=1.0),
            Marks(x=along, y=rows.rate_deg_h - earth_deg_h(loop)),
        ),
        x=Axis(label=Message("dwell") if hours is None else Message("time (min)")),
        y=Axis(label=Message("drift (°/h)")),
    )
    return Figure(name="drift", description=Message("Drift of each dwell over time"), panels=(panel,), height=180.0)


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
