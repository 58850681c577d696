"""The published formula on a table: the mean rates at three of its positions, as a baseline for the fit."""

from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.cramer import coefficients, three_positions
from tumble.calibrations.methods.gyrocompass.geometry import north_rate
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations

_POSITIONS = 3


@dataclass(frozen=True, kw_only=True)
class Baseline:
    """Heading and drift by the formula for three positions."""

    azimuths_deg: tuple[float, ...]
    alpha0_deg: float
    drift_deg_h: float
    closure: float
    """sin² + cos² as they come out."""

    def as_json(self) -> dict[str, Any]:
        """As a result has it."""
        return {
            "name": "three positions",
            "azimuths_deg": list(self.azimuths_deg),
            "alpha0_deg": self.alpha0_deg,
            "drift_deg_h": self.drift_deg_h,
            "closure": self.closure,
        }


def baseline_of(observations: GyrocompassObservations) -> Baseline | None:
    """The formula on the three positions of the first base that determine it best; None where there are fewer."""
    first = observations.select(observations.bases == observations.bases[0])
    means = first.averaged(np.unique(np.round(first.azimuth_deg % 360.0, 2) % 360.0, return_inverse=True)[1])
    if len(means) < _POSITIONS:
        return None
    chosen = list(max(combinations(range(len(means)), _POSITIONS), key=lambda each: _determinant(means, list(each))))
    if _determinant(means, chosen) == 0.0:
        return None
    its = means.over(np.array(chosen))
    gamma_deg: FloatArray | float = 0.0 if its.tilt_gamma_deg is None else its.tilt_gamma_deg
    found = three_positions(its.rate_deg_h, its.azimuth_deg, float(north_rate(its.latitude_deg)[0]), gamma_deg)
    return Baseline(
        azimuths_deg=tuple(its.azimuth_deg.tolist()),
        alpha0_deg=float(found.alpha0_deg),
        drift_deg_h=float(found.drift_deg_h),
        closure=float(found.closure),
    )


def _determinant(means: GyrocompassObservations, chosen: list[int]) -> float:
    """Size of the determinant of the formula, the tilts left out."""
    a, b = coefficients(means.azimuth_deg[chosen], 1.0, 0.0, 0.0)
    return abs(float((a[0] - a[1]) * (b[1] - b[2]) - (a[1] - a[2]) * (b[0] - b[1])))
