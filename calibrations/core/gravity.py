"""Local gravity from where the stand is."""

import math
from dataclasses import dataclass

ANOMALY_M_S2 = 5e-4
"""Standard uncertainty of the formula against a measured value: gravity anomalies are some 50 mGal (EGM2008)."""


@dataclass(frozen=True, kw_only=True)
class Gravity:
    """Local gravity with its standard uncertainty, in m/s²."""

    value_m_s2: float
    standard_uncertainty_m_s2: float


def normal_gravity(latitude_deg: float, height_m: float) -> Gravity:
    """Normal gravity on the WGS 84 ellipsoid with the second-order free-air term (NIMA TR8350.2, 4-1 and 4-3)."""
    sin2 = math.sin(math.radians(latitude_deg)) ** 2
    surface = 9.7803253359 * (1 + 0.00193185265241 * sin2) / math.sqrt(1 - 0.00669437999013 * sin2)
    flattening, axis_m, ratio = 1 / 298.257223563, 6378137.0, 0.00344978650684
    fall = 2 * (1 + flattening + ratio - 2 * flattening * sin2) * height_m / axis_m - 3 * (height_m / axis_m) ** 2
    return Gravity(value_m_s2=surface * (1 - fall), standard_uncertainty_m_s2=ANOMALY_M_S2)
