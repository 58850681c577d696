"""The heading against an azimuth mark: the angle of the platform that was measured otherwise."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.geometry import platform_azimuth_rad, wrapped_deg
from tumble.calibrations.methods.gyrocompass.model import ALPHA0
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable


@dataclass(frozen=True, kw_only=True)
class MarkCheck:
    """α by the rates minus α by the mark, mean over the rows that have one."""

    difference_deg: float
    standard_uncertainty_deg: float
    """Of the heading, and of the mean by its scatter."""
    rows: int

    @property
    def agrees(self) -> bool:
        """Whether both agree within twice the uncertainty."""
        return abs(self.difference_deg) <= 2.0 * self.standard_uncertainty_deg

    def as_json(self) -> dict[str, Any]:
        """As a result has it."""
        return {
            "value": self.difference_deg,
            "standard_uncertainty": self.standard_uncertainty_deg,
            "unit": "deg",
            "agrees": self.agrees,
        }


def mark_check(table: GyrocompassTable, fit: GyrocompassFit) -> MarkCheck | None:
    """Compare with `reference_alpha_deg`; None where the table has none, or no heading follows from it."""
    rows = table.observations
    mark_deg = rows.reference_alpha_deg
    if mark_deg is None or not np.isfinite(mark_deg).any() or not fit.identified[ALPHA0]:
        return None
    alpha = platform_azimuth_rad(float(fit.theta[ALPHA0]), np.deg2rad(rows.azimuth_deg), table.scene.lean)
    off = np.array([wrapped_deg(each) for each in (np.rad2deg(alpha) - mark_deg) if np.isfinite(each)])
    scatter = float(off.std(ddof=1) / np.sqrt(len(off))) if len(off) > 1 else 0.0
    of_heading = float(np.sqrt(fit.parameter_covariance[ALPHA0, ALPHA0]))
    return MarkCheck(
        difference_deg=float(off.mean()), standard_uncertainty_deg=float(np.hypot(scatter, of_heading)), rows=len(off)
    )
