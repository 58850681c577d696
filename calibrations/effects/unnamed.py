"""Structure without a name: shapes that no effect of the catalogue has, by the variable on which they depend.

They compete with the catalogue on the same terms. Where one wins, the residual is reported as unexplained, located on
its variable, and the shape stays in the model only to keep the parameters honest.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from calibrations.effects.effect import Effect, Form, plain
from calibrations.effects.scene import Scene
from calibrations.geometry import FloatArray

Variable: TypeAlias = Literal["angle", "acceleration", "time", "temperature", "direction", "realisation", "order"]

_BUMP_WIDTHS_DEG = (3.0, 8.0, 18.0)
_SECTORS_DEG = (30.0, 60.0, 90.0)
_KINK_WIDTHS_G = (0.04, 0.12)
_WANDERING = 40.0
"""Doubt in a course of any shape in time: a bias that wanders is the better guess."""


@dataclass(frozen=True, kw_only=True)
class Structure(Effect):
    """A family of shapes of one variable."""

    depends_on: Variable
    describe: Callable[[Form], str]
    """Where the structure is, in words."""


def _column(values: FloatArray, **where: float) -> Form:
    return Form(columns=values[:, None], scanned=where)


def _hats(values: FloatArray, count: int, period: float | None = None) -> FloatArray:
    """Broad overlapping bells over a range, or around a period, shape (rows, count): any smooth course."""
    if period is None:
        knots = np.linspace(float(values.min()), float(values.max()), count)
        width = max((knots[-1] - knots[0]) / max(count - 1, 1), 1e-12)
        away = values[:, None] - knots
    else:
        knots, width = np.arange(count) * period / count, period / count
        away = (values[:, None] - knots + period / 2) % period - period / 2
    return np.asarray(np.exp(-0.5 * (away / width) ** 2))


def _bumps(scene: Scene) -> Iterator[Form]:
    """A local error of the head's angle, a bell or a sector somewhere on the circle; or any smooth error of it."""
    yield Form(columns=scene.slope_v_per_deg[:, None] * _hats(scene.angle_deg, 24, 360.0), scanned={"smooth": 24.0})
    for length_deg in _SECTORS_DEG:
        for start_deg in np.arange(0.0, 360.0, 15.0).tolist():
            inside = ((scene.angle_deg - start_deg) % 360.0 < length_deg).astype(float)
            yield _column(scene.slope_v_per_deg * inside, start_deg=start_deg, length_deg=length_deg)
    for width_deg in _BUMP_WIDTHS_DEG:
        for centre_deg in np.arange(0.0, 360.0, max(width_deg, 5.0)).tolist():
            away_deg = (scene.angle_deg - centre_deg + 180.0) % 360.0 - 180.0
            bell = np.exp(-0.5 * (away_deg / width_deg) ** 2)
            yield _column(scene.slope_v_per_deg * bell, centre_deg=centre_deg, width_deg=width_deg)


def _responses(scene: Scene) -> Iterator[Form]:
    """Chebyshev's polynomials of each projection, root-like powers of ax, kinks along ax; or any smooth response."""
    yield Form(columns=_hats(scene.ax_g, 14), scanned={"smooth": 14.0})
    for axis in range(3):
        a_g = scene.gravity_g[:, axis]
        for order in (3, 4, 5, 6, 7) if axis else (4, 5, 6, 7):
            yield _column(np.cos(order * np.arccos(np.clip(a_g, -1.0, 1.0))), axis=axis, order=order)
    for root in (1.5, 2.5):
        yield _column(np.abs(scene.ax_g) ** root, axis=0, power=root)
        yield _column(np.sign(scene.ax_g) * np.abs(scene.ax_g) ** root, axis=0, power=root)
    for width_g in _KINK_WIDTHS_G:
        for centre_g in np.linspace(-0.9, 0.9, 25).tolist():
            bell = np.exp(-0.5 * ((scene.ax_g - centre_g) / width_g) ** 2)
            yield _column(bell, axis=0, centre_g=centre_g)
            yield _column(bell * (scene.ax_g - centre_g) / width_g, axis=0, centre_g=centre_g)


def _times(scene: Scene) -> Iterator[Form]:
    """A period, a step or a bend in time."""
    if scene.hours is None or scene.hours[-1] <= 0:
        return
    hours, run_h = scene.hours, float(scene.hours[-1])
    yield Form(columns=_hats(hours, 16), scanned={"smooth": 16.0}, doubt=_WANDERING)
    for turns in np.arange(0.5, 40.1, 0.5).tolist():
        phase = 2 * np.pi * turns * hours / run_h
        columns = np.column_stack([np.sin(phase), np.cos(phase)])
        yield Form(columns=columns, scanned={"period_s": run_h * 3600.0 / turns})
    for at_h in np.linspace(0.02 * run_h, 0.98 * run_h, 49).tolist():
        yield _column((hours > at_h).astype(float), step_s=at_h * 3600.0)
    for power in (2, 3):
        yield _column((hours / run_h) ** power, power=power)


def _temperatures(scene: Scene) -> Iterator[Form]:
    """Bends of the bias against temperature, and its rate of change."""
    if scene.temperature_k is None:
        return
    spread = max(float(np.ptp(scene.temperature_k)), 1e-9)
    relative = (scene.temperature_k - scene.temperature_k.mean()) / spread
    for power in (2, 3, 4):
        yield _column(relative**power, power=power)
    yield Form(columns=_hats(scene.temperature_k, 8), scanned={"smooth": 8.0})
    for place in np.linspace(-0.45, 0.45, 13).tolist():
        yield _column(np.tanh((relative - place) / 0.05), at_k=place * spread + float(scene.temperature_k.mean()))
    if scene.hours is not None and scene.hours[-1] > 0:
        smooth = np.polynomial.Polynomial.fit(scene.hours, scene.temperature_k, min(8, len(relative) // 20 + 1))
        yield _column(smooth.deriv()(scene.hours), rate=1.0)


def _directions(scene: Scene) -> Iterator[Form]:
    """Bias or response that differs after moves in - direction."""
    back = (scene.direction < 0).astype(float)
    if back.any() and not back.all():
        yield _column(back, bias=1.0)
        yield _column(back * scene.ax_g, scale=1.0)


def _realisations(scene: Scene) -> Iterator[Form]:
    """One realisation whose response differs."""
    for number in range(int(scene.realisation.max(initial=0)) + 1):
        inside = (scene.realisation == number).astype(float)
        if inside.any() and not inside.all():
            yield _column(inside * scene.ax_g, realisation=number + 1)


def _orders(scene: Scene) -> Iterator[Form]:
    """What depends on how many dwells came before within the realisation or the mounting."""
    for groups, name in ((scene.realisation, "realisation"), (scene.mounting, "mounting")):
        starts = np.flatnonzero(np.diff(groups, prepend=-1))
        place = np.arange(len(groups)) - starts[np.searchsorted(starts, np.arange(len(groups)), side="right") - 1]
        relative = place / max(place.max(initial=0), 1)
        yield _column(relative, **{name: 1.0})
        for dwells in (1.0, 3.0, 6.0, 12.0, 25.0, 50.0):
            yield _column(np.exp(-place / dwells), **{name: dwells})


def _words(form: Form) -> str:
    return ", ".join(f"{key} {value:.4g}" for key, value in form.scanned.items())


def _structure(depends_on: Variable, forms: Callable[[Scene], Iterator[Form]], shape: str) -> Structure:
    def listed(scene: Scene) -> Sequence[Form]:
        return tuple(forms(scene))

    return Structure(
        name=f"?{depends_on}",
        belongs_to="unit",
        symbol="",
        source="",
        forms=listed,
        report=plain("amplitude", "V"),
        depends_on=depends_on,
        describe=lambda form: f"{shape} ({_words(form)})",
    )


STRUCTURES = (
    _structure("angle", _bumps, "a local error of the head"),
    _structure("acceleration", _responses, "a bend of the response"),
    _structure("time", _times, "a course in time"),
    _structure("temperature", _temperatures, "a bend against temperature"),
    _structure("direction", _directions, "a difference between the directions of approach"),
    _structure("realisation", _realisations, "a realisation that responds differently"),
    _structure("order", _orders, "a course with the number of dwells"),
)
