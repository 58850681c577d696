"""Plots of what the residual was traced to: the residual against what explains it, before and after."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.report.abscissa import BY_EFFECT, BY_VARIABLE, Abscissa, Column
from tumble.calibrations.methods.dividing_head.report.residuals import (
    groups_of,
    residual_marks,
    scatter_uv,
    weighted_uv,
)
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.figure import Axis, Boxes, Figure, Layer, Panel, on_one_scale, residual_line
from tumble.calibrations.tracing.findings import EffectFound
from tumble.messages import Message, with_wording

MOST_FIGURES = 4
_ARCSEC_PER_DEG = 3600.0
_STEEP = 0.5
"""An error of the angle is read off rows where the output changes with the angle at least by that part of the most."""
_NAMED_LEVELS = 12


@dataclass(frozen=True, kw_only=True)
class Points:
    """What is drawn in one panel."""

    x: Column
    y: FloatArray
    scatter: float
    below: NDArray[np.bool_]
    """Whether each row is of the second kind that is drawn apart; all False where there is one kind."""


def abscissae(loop: Loop) -> dict[Abscissa, list[str]]:
    """What to draw the residual against, each with what is to be seen there, in the order of the evidence."""
    wanted: dict[Abscissa, list[str]] = {}
    for effect in loop.effects:
        if abscissa := _abscissa(effect):
            wanted.setdefault(abscissa, []).append(effect.name)
    if loop.unexplained:
        wanted.setdefault(BY_VARIABLE[loop.unexplained.depends_on], []).append(Message("what is unexplained"))
    return dict(list(wanted.items())[:MOST_FIGURES])


def _abscissa(effect: EffectFound) -> Abscissa | None:
    """What shows an effect: its variable where nothing nearer is known; None for what is no column (a misreading)."""
    by_variable = {each.word: BY_VARIABLE[each.depends_on] for each in CATALOGUE}
    depends_on = BY_VARIABLE[effect.depends_on] if effect.depends_on else None
    return BY_EFFECT.get(effect.name) or by_variable.get(effect.name) or depends_on


def trace_figure(models: Mapping[str, Calibration], abscissa: Abscissa) -> Figure | None:
    """Residual of each model, by its title, side by side; None where the table does not say what explains it."""
    panels = []
    for title, calibration in models.items():
        points = _points(calibration, abscissa)
        if points is None:
            return None
        panels.append(_panel(points, abscissa, title))
    title = Message(
        "Residual against {variable}: {models}", variable=abscissa.label, models=Message.joined(", ", models)
    )
    return Figure(
        name=f"trace-{abscissa.name}",
        description=title,
        panels=on_one_scale(panels),
        columns=len(panels),
        height=220.0,
    )


def _panel(points: Points, abscissa: Abscissa, title: str) -> Panel:
    ticks, names = _levels(points.x) if abscissa.levels else ((), ())
    marks = _boxes(points) if abscissa.levels else _marks(points, abscissa)
    return Panel(
        layers=(*residual_line(points.scatter), *marks),
        title=title,
        x=Axis(label=abscissa.label, ticks=ticks, names=names),
        y=Axis(label=Message("residual as an angle (″)") if abscissa.as_angle else Message("residual (µV)")),
    )


def _points(calibration: Calibration, abscissa: Abscissa) -> Points | None:
    theta = np.array([parameter.value or 0.0 for parameter in calibration.parameters.values()])
    scene = scene_of(calibration.observations, theta)
    values = abscissa.values(scene)
    if values is None or len(set(values.tolist())) < 2:
        return None
    below = abscissa.sides.below(scene) if abscissa.sides else np.zeros(len(values), dtype=bool)
    points = Points(x=values, y=weighted_uv(calibration), scatter=scatter_uv(calibration), below=below)
    return _as_angle(points, scene) if abscissa.as_angle else points


def _as_angle(points: Points, scene: Scene) -> Points | None:
    """The error of the angle that would make the residual, in seconds of arc, where the output is steep enough."""
    slope = scene.slope_v_per_deg * 1e6 / _ARCSEC_PER_DEG
    steep = np.abs(slope) > _STEEP * np.abs(slope).max()
    if not steep.any():
        return None
    typical = float(np.sqrt(np.mean(slope[steep] ** 2)))
    return Points(
        x=points.x[steep],
        y=points.y[steep] / slope[steep],
        scatter=points.scatter / typical,
        below=points.below[steep],
    )


def _marks(points: Points, abscissa: Abscissa) -> Iterator[Layer]:
    below = points.below
    if abscissa.sides is None or not below.any() or below.all():
        yield from residual_marks(points.x, points.y, groups_of(points.x, abscissa.bins), points.scatter, 0)
        return
    for number, (inside, label) in enumerate(zip((~below, below), abscissa.sides.labels, strict=True)):
        x, y = points.x[inside], points.y[inside]
        yield from residual_marks(x, y, groups_of(x, abscissa.bins), points.scatter, number, label)


def _boxes(points: Points) -> Iterator[Layer]:
    levels, group = np.unique(points.x, return_inverse=True)
    yield Boxes(groups=[points.y[group == number] for number in range(len(levels))])


def _levels(values: Column) -> tuple[list[float], list[str]]:
    """Places of the names of levels, and these; of many some."""
    levels = np.unique(values)
    step = -(-len(levels) // _NAMED_LEVELS)
    return [float(place) for place in range(0, len(levels), step)], [with_wording(str(each)) for each in levels[::step]]
