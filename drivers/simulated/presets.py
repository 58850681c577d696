"""Units by name, so that a stand file need not spell out every coefficient."""

from dataclasses import dataclass
from types import MappingProxyType
from typing import Final


@dataclass(frozen=True, kw_only=True)
class UnitParameters:
    """Coefficients of `u = u0 + kx ax + ky ay + kz az + kxy ax ay` and the angle of the seat; g is local g."""

    u0: float
    """Bias, in V."""
    kx: float
    """Scale factor, in V/g."""
    ky: float
    """Cross-axis sensitivity to ay, in V/g."""
    kz: float
    """Cross-axis sensitivity to az, in V/g."""
    kxy: float
    """Vibropendulous coefficient, in V/g²."""
    alpha0_deg: float
    """Angle from the head's zero to the seat, in degrees, the same in every mount."""


@dataclass(frozen=True, kw_only=True)
class Preset:
    """A unit and how noisy it is."""

    parameters: UnitParameters
    noise_v: float
    """Standard deviation of one sample, in V."""


PRESETS: Final = MappingProxyType(
    {
        # Avrutov, Bondar, Meleshko 2008, the published result; kz and the noise are of a plausible size.
        "DXL203EB": Preset(
            parameters=UnitParameters(u0=2.5, kx=1.0, ky=0.0098, kz=0.002, kxy=0.001, alpha0_deg=0.1121),
            noise_v=1e-3,
        ),
        "ideal": Preset(
            parameters=UnitParameters(u0=0.0, kx=1.0, ky=0.0, kz=0.0, kxy=0.0, alpha0_deg=0.0), noise_v=0.0
        ),
    }
)
"""Every preset by the name that a stand file may use."""
