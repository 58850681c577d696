"""Plots of the residuals: measured minus fitted, against everything that the table says of a row."""

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray
from scipy.special import ndtri

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.poses import pose_groups
from tumble.calibrations.methods.dividing_head.report.subject import mounts_of
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.report.drawing import (
    BAND,
    COLOURS,
    CURVE,
    HALF_IN,
    INK,
    MARKERS,
    MICRO,
    WIDE_IN,
    cloud,
    sheet,
    styled,
    to_svg,
)
from tumble.messages import Message, with_wording

BINS = 30
"""Groups of equally many rows whose means are shown against a quantity that never repeats."""


@styled
def angle_figure(calibration: Calibration) -> Markup:
    """Residual against head angle within one turn, one strip a mount, with the means of repeated poses."""
    observations = calibration.observations
    mounts = mounts_of(observations)
    figure, axes = sheet(WIDE_IN, 0.6 + min(1.6, 8.0 / len(mounts)) * len(mounts), len(mounts), 1)
    residual_uv, angles = weighted_uv(calibration), np.mod(observations.angle_deg, 360.0)
    poses = pose_groups(observations)
    for index, (panel, mount) in enumerate(zip(axes, mounts, strict=True)):
        at = observations.mounts == mount
        band(panel, scatter_uv(calibration))
        mark_residuals(panel, angles[at], residual_uv[at], poses[at], scatter_uv(calibration), index)
        panel.set_title(with_wording(mount))
        panel.set_ylabel(Message("residual (µV)"))
    axes[-1].set_xlabel(Message("head angle within the turn (°)"))
    axes[-1].set_xticks(range(0, 361, 45))
    return to_svg(figure, "by-angle", Message("Residual against head angle, by mount, with means of repeated poses"))


@styled
def covariate_figures(calibration: Calibration) -> dict[str, Markup]:
    """Residual against time, temperature and realisation, those that the table has, by name."""
    observations = calibration.observations
    columns: dict[str, tuple[FloatArray | NDArray[np.int64] | None, str]] = {
        "time": (observations.time_s, Message("time (s)")),
        "temperature": (observations.temperature_degc, Message("temperature (°C)")),
        "realisation": (observations.realisation, Message("realisation")),
    }
    return {
        name: _covariate_figure(calibration, np.asarray(values, dtype=float), name, label)
        for name, (values, label) in columns.items()
        if values is not None and np.isfinite(values).all() and np.ptp(values) > 0
    }


def _covariate_figure(calibration: Calibration, values: FloatArray, name: str, label: str) -> Markup:
    figure, (panel,) = sheet(HALF_IN, 2.8)
    groups = groups_of(values)
    band(panel, scatter_uv(calibration))
    mark_residuals(panel, values, weighted_uv(calibration), groups, scatter_uv(calibration), 0)
    panel.set_xlabel(label)
    panel.set_ylabel(Message("residual (µV)"))
    if name == "realisation":
        panel.xaxis.set_major_locator(MaxNLocator(integer=True))
    return to_svg(figure, f"by-{name}", Message("Residual against {variable}", variable=label))


@styled
def normal_figure(calibration: Calibration) -> Markup:
    """Ordered residuals against normal quantiles (Blom's positions), with the line of normal scatter of their size."""
    residual_uv = np.sort(weighted_uv(calibration))
    count = len(residual_uv)
    quantiles = ndtri((np.arange(1, count + 1) - 0.375) / (count + 0.25))
    figure, (panel,) = sheet(HALF_IN, 2.8)
    line = np.array([quantiles[0], quantiles[-1]])
    panel.plot(line, line * np.std(residual_uv), color=CURVE, linewidth=0.9)
    cloud(panel, quantiles, residual_uv, 0, strong=True)
    panel.set_xlabel(Message("normal quantile"))
    panel.set_ylabel(Message("residual (µV)"))
    return to_svg(figure, "normal", Message("Normal probability plot of the residuals"))


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


def band(panel: Axes, scatter: float) -> None:
    """The line of zero with the scatter of a row on both sides."""
    panel.axhspan(-scatter, scatter, color=BAND, alpha=0.18, linewidth=0)
    panel.axhline(0.0, color=INK, linewidth=0.7)


def mark_residuals(
    panel: Axes, values: FloatArray, residuals: FloatArray, groups: NDArray[np.int64], scatter: float, colour: int
) -> None:
    """Mark the rows, and the means of groups with twice their standard uncertainty."""
    cloud(panel, values, residuals, colour, strong=False)
    _, group = np.unique(groups, return_inverse=True)
    count = np.bincount(group)
    if count.max() < 2:
        return
    panel.errorbar(
        np.bincount(group, values) / count,
        np.bincount(group, residuals) / count,
        yerr=2 * scatter / np.sqrt(count),
        fmt=MARKERS[colour % len(MARKERS)],
        color=COLOURS[colour % len(COLOURS)],
        markersize=3,
        linewidth=0.7,
    )
