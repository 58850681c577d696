"""The declared model fitted to the points of a run so far."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.model import basis, coefficients
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.procedures.methods.dividing_head.rows import Row

FEWEST_POINTS = 10
"""Points below which ten functions of the pose fit anything."""


@dataclass(frozen=True, kw_only=True)
class LiveFit:
    """What the points so far say."""

    points: int
    """How many there were."""
    residual_v: FloatArray
    """Of every point, gross errors included, shape (points,), in volts; NaN for one without a voltage."""
    scatter_v: float
    curves: Mapping[str, tuple[FloatArray, FloatArray]]
    """Head angle in degrees and model output in volts, by mount."""
    gross: tuple[int, ...]
    """Indices of points that the fit sets aside."""


def fit_live(points: Sequence[Row]) -> LiveFit | None:
    """Fit the points of a run; None while there are too few of them."""
    from tumble.calibrations.methods.dividing_head.joint import fit_jointly  # takes the time in which a window is up

    if len(points) < FEWEST_POINTS:
        return None
    table = _table(points)
    usable = table.select(np.isfinite(table.output_v))
    if len(usable) < FEWEST_POINTS:
        return None
    joint = fit_jointly(usable)
    theta = coefficients(joint.fit.theta)
    return LiveFit(
        points=len(points),
        residual_v=table.output_v - basis(table) @ theta,
        scatter_v=joint.noise.used_v,
        curves={mount: _curve(table, mount, theta) for mount in dict.fromkeys(table.mounts.tolist())},
        gross=tuple(int(entry.row) - 1 for entry in joint.observations.set_aside if entry.gross),
    )


def _table(points: Sequence[Row]) -> Observations:
    return Observations(
        row=np.arange(1, len(points) + 1),
        angle_deg=np.array([point.angle_deg for point in points]),
        voltage_v=np.array([point.voltage_v if abs(point.voltage_v) < 1e30 else np.nan for point in points]),
        time_s=np.array([point.time_s for point in points]),
        realisation=np.array([point.realisation for point in points]),
        procedure=np.array([point.procedure for point in points]),
        mount=np.array([point.mount for point in points]),
        direction=np.array([point.direction for point in points]),
        voltage_sd_v=np.array([point.voltage_sd_v for point in points]),
        samples=np.array([point.samples for point in points]),
    )


def _curve(table: Observations, mount: str, theta: FloatArray) -> tuple[FloatArray, FloatArray]:
    angles_deg = table.angle_deg[table.mounts == mount]
    grid_deg = np.linspace(angles_deg.min(), angles_deg.max(), 181)
    shown = Observations(row=np.arange(len(grid_deg)), angle_deg=grid_deg, mount=np.full(len(grid_deg), mount))
    return grid_deg, np.asarray(basis(shown) @ theta)
