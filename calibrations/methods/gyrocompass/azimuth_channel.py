"""The drift of the azimuth channel, from its rate at known heading and tilt, and the heading kept by dead reckoning.

    S2 = ωζ cos γ + ωη sin α sin γ + ω2,

Meleshko, Kornejchuk, Skudneva 2008, equation 7, with β held at 0. What is calibrated in several azimuths is the drift
of the levelling channel; in flight the heading wanders with ω2.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions, up_rate
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, direction
from tumble.calibrations.methods.gyrocompass.table import GyrocompassTable
from tumble.messages import Message

HOURS: Final = (0.25, 0.5, 1.0, 2.0, 4.0)
"""After which the heading is stated."""
NOT_MEASURED: Final = Message("its rate was not measured: azimuth_rate_deg_h in two dwells at least")
"""Why a table says nothing of ω2."""


@dataclass(frozen=True, kw_only=True)
class AzimuthDrift:
    """ω2, its mean over the table."""

    value_deg_h: float
    standard_uncertainty_deg_h: float
    dwells: int

    def as_json(self, alpha0_u_deg: float) -> dict[str, Any]:
        """As a result has it, with the uncertainty of the heading after some hours."""
        return {
            "value": self.value_deg_h,
            "standard_uncertainty": self.standard_uncertainty_deg_h,
            "unit": "°/h",
            "heading_uncertainty_deg": {
                f"{hours:g} h": heading_uncertainty_deg(hours, alpha0_u_deg, self.standard_uncertainty_deg_h)
                for hours in HOURS
            },
        }


def azimuth_drift(table: GyrocompassTable, fit: GyrocompassFit) -> AzimuthDrift | None:
    """ω2 by the rows that have a rate of the azimuth channel; None where there are fewer than two."""
    rows = table.observations
    if rows.azimuth_rate_deg_h is None or np.isfinite(rows.azimuth_rate_deg_h).sum() < 2:
        return None
    lean, delta = table.scene.lean, np.deg2rad(rows.azimuth_deg)
    sine = lean.sin_tilt(delta)
    cosine = np.sqrt(1.0 - sine**2)
    north = heading_functions(delta, rows.latitude_deg, lean) @ direction(float(fit.theta[ALPHA0]))
    each = rows.azimuth_rate_deg_h - up_rate(rows.latitude_deg) * cosine - north * sine / cosine
    known = each[np.isfinite(each)]
    return AzimuthDrift(
        value_deg_h=float(known.mean()),
        standard_uncertainty_deg_h=float(known.std(ddof=1) / np.sqrt(len(known))),
        dwells=len(known),
    )


def heading_uncertainty_deg(
    hours: float, alpha0_deg: float, drift_deg_h: float, noise: DriftNoise | None = None
) -> float:
    """Standard uncertainty of a heading so many hours after it was found, with ω2 taken off, in degrees.

    Parameters
    ----------
    alpha0_deg, drift_deg_h
        Standard uncertainties of the heading at the start and of ω2.
    noise
        How ω2 wanders; the heading is its integral. 0.2 °/h with 1/1000 s alone give 0.29° in 4 h.
    """
    wandered = 0.0 if noise is None else _mean_variance(hours, noise) * hours**2
    return float(np.sqrt(alpha0_deg**2 + (drift_deg_h * hours) ** 2 + wandered))


def _mean_variance(hours: float, noise: DriftNoise) -> float:
    """Variance of the mean of the drift over a time from now, in (°/h)²."""
    start: FloatArray = np.zeros(1)
    return float(noise.covariance(start, start + 3600.0 * hours)[0, 0])
