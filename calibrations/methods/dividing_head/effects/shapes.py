"""Shapes of one variable each, in which structure without a name may come."""

from collections.abc import Iterator

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Form, contrasts

_MOST_SETTINGS = 80
_BELL_WIDTHS_DEG = (3.0, 8.0, 18.0)
_BUMP_WIDTHS_G = (0.05, 0.08, 0.12, 0.18)
_ANY_COURSE = 20.0
"""Penalty of a course of any shape: one that has a shape is the better guess."""
_WANDERING = 40.0
"""Penalty of a course of any shape in time: a bias that wanders is the better guess."""


def _column(values: FloatArray, **where: float) -> Form:
    return Form(columns=values[:, None], scanned=where)


def _bells(values: FloatArray, count: int, period: float | None = None) -> FloatArray:
    """Broad overlapping bells over a range, or around a period, shape (rows, count): any smooth course."""
    if period is None:
        knots = np.linspace(float(values.min()), float(values.max()), count)
        width = max((knots[-1] - knots[0]) / max(count - 1, 1), 1e-12)
        away = values[:, None] - knots
    else:
        knots, width = np.arange(count) * period / count, period / count
        away = (values[:, None] - knots + period / 2) % period - period / 2
    return np.asarray(np.exp(-0.5 * (away / width) ** 2))


def head_bells(scene: Scene) -> Iterator[Form]:
    """A local error of the head's angle."""
    for width_deg in _BELL_WIDTHS_DEG:
        for centre_deg in np.arange(0.0, 360.0, max(width_deg, 5.0)).tolist():
            away_deg = (scene.angle_deg - centre_deg + 180.0) % 360.0 - 180.0
            bell = np.exp(-0.5 * (away_deg / width_deg) ** 2)
            yield _column(scene.slope_v_per_deg * bell, centre_deg=centre_deg, width_deg=width_deg)


def head_course(scene: Scene) -> Iterator[Form]:
    """Any smooth error of the head, or any error at each setting; a mean error is alpha0's."""
    slope = scene.slope_v_per_deg[:, None]
    smooth = slope * _bells(scene.angle_deg, 24, 360.0) @ contrasts(24)
    yield Form(columns=smooth, scanned={"knots": 24.0}, penalty=_ANY_COURSE)
    settings, setting = np.unique(np.round(scene.angle_deg % 360.0, 1), return_inverse=True)
    if len(settings) <= min(_MOST_SETTINGS, len(setting) // 6):
        at_each = (setting[:, None] == np.arange(len(settings))).astype(float)
        columns = slope * at_each @ contrasts(len(settings))
        yield Form(columns=columns, scanned={"knots": float(len(settings))}, penalty=_ANY_COURSE)


def polynomials(scene: Scene) -> Iterator[Form]:
    """Chebyshev's polynomials of each projection, and root-like powers of ax."""
    for axis in range(3):
        a_g = scene.gravity_g[:, axis]
        for order in (3, 4, 5, 6, 7) if axis else (4, 5, 6, 7):
            yield _column(np.cos(order * np.arccos(np.clip(a_g, -1.0, 1.0))), axis=axis, order=order)
    for power in (1.5, 2.5):
        yield _column(np.abs(scene.ax_g) ** power, axis=0, power=power)
        yield _column(np.sign(scene.ax_g) * np.abs(scene.ax_g) ** power, axis=0, power=power)


def zones(scene: Scene) -> Iterator[Form]:
    """Another slope near ax = 0."""
    for width_g in _BUMP_WIDTHS_G:
        yield _column(scene.ax_g / width_g * np.exp(-0.5 * (scene.ax_g / width_g) ** 2), width_g=width_g)


def bumps(scene: Scene) -> Iterator[Form]:
    """A bump of the output near one ax."""
    for width_g in _BUMP_WIDTHS_G:
        for centre_g in np.linspace(-0.9, 0.9, 37).tolist():
            bell = np.exp(-0.5 * ((scene.ax_g - centre_g) / width_g) ** 2)
            yield _column(bell, centre_g=centre_g, width_g=width_g)


def response_course(scene: Scene) -> Iterator[Form]:
    """Any smooth response to ax."""
    for count in (14, 36):
        yield Form(columns=_bells(scene.ax_g, count), scanned={"knots": float(count)}, penalty=_ANY_COURSE)


def time_bends(scene: Scene) -> Iterator[Form]:
    """A drift that is no straight line."""
    for hours in _hours(scene):
        part = hours / hours[-1]
        for power in (2, 3):
            yield _column(part**power, power=power)
        yield _column((2.0 * part - 1.0) ** 2, power=2.0, turning_h=float(hours[-1]) / 2)


def time_periods(scene: Scene) -> Iterator[Form]:
    """A wave in time with any phase."""
    for hours in _hours(scene):
        for turns in np.arange(0.5, 40.1, 0.25).tolist():
            phase = 2 * np.pi * turns * hours / hours[-1]
            period_s = float(hours[-1]) * 3600.0 / turns
            yield Form(columns=np.column_stack([np.sin(phase), np.cos(phase)]), scanned={"period_s": period_s})


def time_steps(scene: Scene) -> Iterator[Form]:
    """A jump at some time."""
    for hours in _hours(scene):
        for at_h in np.linspace(0.01 * hours[-1], 0.99 * hours[-1], 150).tolist():
            yield _column((hours > at_h).astype(float), step_s=at_h * 3600.0)


def time_course(scene: Scene) -> Iterator[Form]:
    """Any smooth course in time."""
    for hours in _hours(scene):
        yield Form(columns=_bells(hours, 16), scanned={"knots": 16.0}, penalty=_WANDERING)


def _hours(scene: Scene) -> Iterator[FloatArray]:
    """Time over the run, if there is any."""
    if scene.hours is not None and scene.hours[-1] > 0:
        yield scene.hours


def temperature_bends(scene: Scene) -> Iterator[Form]:
    """A dependence on temperature that is no straight line."""
    for temperature_k in _temperature(scene):
        relative = (temperature_k - temperature_k.mean()) / np.ptp(temperature_k)
        for turning in np.linspace(-0.2, 0.2, 9).tolist():
            yield _column((relative - turning) ** 2, power=2.0, turning=turning)
        for power in (3, 4):
            yield _column(relative**power, power=power)


def temperature_steps(scene: Scene) -> Iterator[Form]:
    """A transition within a small part of the range."""
    for temperature_k in _temperature(scene):
        for place in np.linspace(0.05, 0.95, 25).tolist():
            at_k = float(temperature_k.min() + place * np.ptp(temperature_k))
            step = np.tanh((temperature_k - at_k) / (0.04 * np.ptp(temperature_k)))
            yield _column(step, at_degc=at_k + scene.reference_temperature_degc)


def temperature_course(scene: Scene) -> Iterator[Form]:
    """Any smooth course against temperature, or its rate of change."""
    for temperature_k in _temperature(scene):
        yield Form(columns=_bells(temperature_k, 8), scanned={"knots": 8.0}, penalty=_ANY_COURSE)
        for hours in _hours(scene):
            smooth = np.polynomial.Polynomial.fit(hours, temperature_k, min(8, len(hours) // 20 + 1))
            yield _column(smooth.deriv()(hours), rate=1.0)


def _temperature(scene: Scene) -> Iterator[FloatArray]:
    """Temperature above the reference, if it was measured and changes."""
    if scene.temperature_k is not None and np.ptp(scene.temperature_k) > 0:
        yield scene.temperature_k


def directions(scene: Scene) -> Iterator[Form]:
    """Bias or response that differs after moves in - direction."""
    back = (scene.direction < 0).astype(float)
    if back.any() and not back.all():
        yield _column(back, bias=1.0)
        yield _column(back * scene.ax_g, scale=1.0)


def realisations(scene: Scene) -> Iterator[Form]:
    """One realisation whose response differs."""
    for number in range(int(scene.realisation.max(initial=0)) + 1):
        inside = (scene.realisation == number).astype(float)
        if inside.any() and not inside.all():
            yield _column(inside * scene.ax_g, realisation=number + 1)


def orders(scene: Scene) -> Iterator[Form]:
    """What depends on how many dwells came before: within a realisation or a mounting; at all, if time is lacking."""
    if scene.hours is None:
        yield _column(np.linspace(0.0, 1.0, len(scene.angle_deg)), table=1.0)
    for groups, name in ((scene.realisation, "realisation"), (scene.mounting, "mounting")):
        starts = np.flatnonzero(np.diff(groups, prepend=-1))
        place = np.arange(len(groups)) - starts[np.searchsorted(starts, np.arange(len(groups)), side="right") - 1]
        relative = place / max(place.max(initial=0), 1)
        yield _column(relative, **{name: 1.0})
        for dwells in (1.0, 3.0, 6.0, 12.0, 25.0, 50.0):
            yield _column(np.exp(-place / dwells), **{name: dwells})
