"""Local gravity from where the stand is."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tumble.calibrations.core.parameter import Parameter

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


@dataclass(frozen=True, kw_only=True)
class PerAcceleration:
    """A coefficient per m/s² instead of per local g."""

    value: float
    standard_uncertainty: float
    unit: str

    def as_json(self) -> dict[str, Any]:
        """The coefficient as a result has it."""
        return {"value": self.value, "standard_uncertainty": self.standard_uncertainty, "unit": self.unit}


def per_acceleration(parameters: Mapping[str, Parameter], gravity: Gravity) -> dict[str, PerAcceleration]:
    """Coefficients per m/s²: divided by local g, once for V/g and twice for V/g²; its uncertainty enters here alone."""
    relative = gravity.standard_uncertainty_m_s2 / gravity.value_m_s2
    result = {}
    for name, parameter in parameters.items():
        power = {"V/g": 1, "V/g^2": 2}.get(parameter.unit, 0)
        if power and parameter.value is not None and parameter.standard_uncertainty is not None:
            scale = gravity.value_m_s2**power
            result[name] = PerAcceleration(
                value=parameter.value / scale,
                standard_uncertainty=math.hypot(parameter.standard_uncertainty, power * relative * parameter.value)
                / scale,
                unit=parameter.unit.replace("g^2", "(m/s^2)^2").replace("/g", "/(m/s^2)"),
            )
    return result
