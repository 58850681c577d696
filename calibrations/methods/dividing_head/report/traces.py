"""Plots of what the residual was traced to: the residual against what explains it, before and after."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.report.abscissa import BY_EFFECT, BY_VARIABLE, Abscissa, Column
from tumble.calibrations.methods.dividing_head.report.residuals import (
    band,
    groups_of,
    mark_residuals,
    scatter_uv,
    weighted_uv,
)
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.drawing import COLOURS, HALF_IN, INK, sheet, styled, to_svg
from tumble.calibrations.tracing.findings import EffectFound
from tumble.messages import Message

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


@styled
def trace_figure(models: Mapping[str, Calibration], abscissa: Abscissa) -> Markup | None:
    """Residual of each model, by its title, side by side; None where the table does not say what explains it."""
    figure, axes = sheet(max(len(models) * HALF_IN + 0.2, HALF_IN + 1.5), 2.9, 1, len(models))
    for panel, (title, calibration) in zip(axes, models.items(), strict=True):
        points = _points(calibration, abscissa)
        if points is None:
            return None
        band(panel, points.scatter)
        draw = _boxes if abscissa.levels else _marks
        draw(panel, points, abscissa)
        panel.set_title(title)
        panel.set_xlabel(abscissa.label)
    if axes[-1].get_legend_handles_labels()[0]:
        axes[-1].legend(loc="upper right", ncols=2)
    axes[0].set_ylabel(Message("residual as an angle (″)") if abscissa.as_angle else Message("residual (µV)"))
    title = Message(
        "Residual against {variable}: {models}", variable=abscissa.label, models=Message.joined(", ", models)
    )
    return to_svg(figure, f"trace-{abscissa.name}", title)


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


def _marks(panel: Axes, points: Points, abscissa: Abscissa) -> None:
    below = points.below
    if abscissa.sides is None or not below.any() or below.all():
        mark_residuals(panel, points.x, points.y, groups_of(points.x, abscissa.bins), points.scatter, 0)
        return
    for colour, (inside, label) in enumerate(zip((~below, below), abscissa.sides.labels, strict=True)):
        x, y = points.x[inside], points.y[inside]
        mark_residuals(panel, x, y, groups_of(x, abscissa.bins), points.scatter, colour)
        panel.plot([], [], "o", color=COLOURS[colour], markersize=4, label=label)


def _boxes(panel: Axes, points: Points, abscissa: Abscissa) -> None:  # noqa: ARG001  # drawn like `_marks`
    """Median, quartiles, and whiskers to the last row within 1.5 times their distance (Tukey)."""
    levels, group = np.unique(points.x, return_inverse=True)
    panel.boxplot(
        [points.y[group == number] for number in range(len(levels))],
        positions=range(len(levels)),
        widths=0.55,
        patch_artist=True,
        boxprops={"facecolor": "white", "edgecolor": COLOURS[0]},
        medianprops={"color": COLOURS[1], "linewidth": 1.6},
        whiskerprops={"color": COLOURS[0]},
        capprops={"color": COLOURS[0]},
        flierprops={"marker": ".", "markersize": 3, "markeredgecolor": INK},
    )
    step = -(-len(levels) // _NAMED_LEVELS)
    panel.set_xticks(range(0, len(levels), step), [str(level) for level in levels[::step]])
    panel.yaxis.set_major_locator(MaxNLocator())
