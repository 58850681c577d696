"""Plots of the residuals: measured minus fitted, against everything that the table says of a row."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.poses import pose_groups
from tumble.calibrations.methods.dividing_head.report.subject import mounts_of
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.figure import (
    COLOURS,
    INK,
    MICRO,
    PALE,
    SHAPES,
    Axis,
    Figure,
    Layer,
    Line,
    Marks,
    Panel,
    on_one_scale,
    residual_line,
)
from tumble.messages import Message, with_wording

BINS = 30
"""Groups of equally many rows whose means are shown against a quantity that never repeats."""
_QUARTERS = tuple(range(0, 361, 45))


def angle_figure(calibration: Calibration) -> Figure:
    """Residual against head angle within one turn, one strip a mount, with the means of repeated poses."""
    observations = calibration.observations
    mounts = mounts_of(observations)
    residual_uv, angles = weighted_uv(calibration), np.mod(observations.angle_deg, 360.0)
    poses, scatter = pose_groups(observations), scatter_uv(calibration)
    panels = []
    for index, mount in enumerate(mounts):
        at = observations.mounts == mount
        marks = residual_marks(angles[at], residual_uv[at], poses[at], scatter, index)
        label = Message("head angle within the turn (°)") if index == len(mounts) - 1 else ""
        panels.append(
            Panel(
                layers=(*residual_line(scatter), *marks),
                title=with_wording(mount),
                x=Axis(label=label, ticks=_QUARTERS),
                y=Axis(label=Message("residual (µV)")),
            )
        )
    return Figure(
        name="by-angle",
        description=Message("Residual against head angle, by mount, with means of repeated poses"),
        panels=on_one_scale(panels),
        height=min(140.0, 660.0 / len(mounts)),
    )


def covariate_figure(calibration: Calibration) -> Figure:
    """Residual against time, temperature and realisation, those that the table has, and how normal it is."""
    panels = [*_covariates(calibration), _normal(calibration)]
    labels = Message.joined(", ", [panel.x.label for panel in panels])
    return Figure(
        name="by-covariate",
        description=Message("Residual against {variable}", variable=labels),
        panels=tuple(panels),
        columns=min(len(panels), 2),
        height=200.0,
    )


def _covariates(calibration: Calibration) -> Iterator[Panel]:
    observations = calibration.observations
    columns: dict[str, FloatArray | NDArray[np.int64] | None] = {
        Message("time (s)"): observations.time_s,
        Message("temperature (°C)"): observations.temperature_degc,
        Message("realisation"): observations.realisation,
    }
    scatter = scatter_uv(calibration)
    for label, column in columns.items():
        if column is None:
            continue
        values = np.asarray(column, dtype=float)
        if np.isfinite(values).all() and np.ptp(values) > 0:
            marks = residual_marks(values, weighted_uv(calibration), groups_of(values), scatter, 0)
            yield Panel(
                layers=(*residual_line(scatter), *marks),
                x=Axis(label=label, whole=column is observations.realisation),
                y=Axis(label=Message("residual (µV)")),
            )


def _normal(calibration: Calibration) -> Panel:
    """Ordered residuals against normal quantiles (Blom's positions), with the line of normal scatter of their size."""
    residual_uv = np.sort(weighted_uv(calibration))
    count = len(residual_uv)
    quantiles = ndtri((np.arange(1, count + 1) - 0.375) / (count + 0.25))
    line = np.array([quantiles[0], quantiles[-1]])
    return Panel(
        layers=(
            Line(x=line, y=line * np.std(residual_uv), colour=INK, width=0.9),
            Marks(x=quantiles, y=residual_uv, opacity=0.8),
        ),
        x=Axis(label=Message("normal quantile")),
        y=Axis(label=Message("residual (µV)")),
    )


def weighted_uv(calibration: Calibration) -> FloatArray:
    """Residuals on the scale of a row of weight 1, in microvolts."""
    return np.asarray(calibration.residual_v * np.sqrt(calibration.weights) * MICRO)


def scatter_uv(calibration: Calibration) -> float:
    """Scatter of one dwell between repeats, or about the fit where there are none, in microvolts."""
    noise = calibration.noise
    return (noise.used_v if noise.pure_error_v is None else noise.pure_error_v) * MICRO


def groups_of(values: FloatArray, bins: int = BINS) -> NDArray[np.int64]:
    """Group of each row: equal values, or, where there are too many of them, neighbours in groups of equal size."""
    distinct, groups = np.unique(values, return_inverse=True)
    if len(distinct) > bins:
        groups = np.argsort(np.argsort(values, kind="stable")) * bins // len(values)
    return np.asarray(groups, dtype=np.int64)


def residual_marks(
    values: FloatArray, residuals: FloatArray, groups: NDArray[np.int64], scatter: float, number: int, label: str = ""
) -> Iterator[Layer]:
    """The rows, pale, and the means of groups with twice their standard uncertainty, in colour and shape `number`."""
    yield Marks(x=values, y=residuals, colour=PALE, shape="dot", size=1.7, opacity=0.6)
    _, group = np.unique(groups, return_inverse=True)
    count = np.bincount(group)
    if count.max() < 2 and not label:
        return
    mean, reach = np.bincount(group, residuals) / count, 2 * scatter / np.sqrt(count)
    yield Marks(
        x=np.bincount(group, values) / count,
        y=mean,
        y_ends=(mean - reach, mean + reach),
        colour=COLOURS[number % len(COLOURS)],
        shape=SHAPES[number % len(SHAPES)],
        bar=0.7,
        label=label,
    )
