"""A tilt of the head's axis beyond what is linear in it.

Of gravity, cos τ is left in the plane in which the head turns: responses that are linear in it fall by as much, that of
the product by cos² τ. In no row does that differ from a smaller response of the unit, so that it must be taken into
account, not fitted: one degree is 150 ppm.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import Source
from tumble.calibrations.methods.dividing_head.model import BASIS_SIZE, coefficients
from tumble.calibrations.tracing.trace import Found
from tumble.messages import Message

_AXIS_TILT: Final = "axis_tilt"
_LINEAR, _PRODUCTS = slice(1, 7), slice(7, BASIS_SIZE)
"""Of the functions of the declared model."""


@dataclass(frozen=True, kw_only=True)
class Tilt:
    """A tilt of the head's axis as it was found; none where it was not."""

    rad: float = 0.0
    standard_uncertainty_rad: float = 0.0

    def foreshortened(self, functions: FloatArray) -> FloatArray:
        """The ten functions of the declared model, shape (rows, 10), with less of gravity in the plane."""
        factors = np.ones(BASIS_SIZE)
        factors[_LINEAR], factors[_PRODUCTS] = np.cos(self.rad), np.cos(self.rad) ** 2
        return np.asarray(functions * factors)

    def sources(self, functions: FloatArray, theta: FloatArray) -> tuple[Source, ...]:
        """What is not known of it, as errors of the rows, for foreshortened functions; nothing where there is none."""
        if not self.rad:
            return ()
        in_plane_v = functions[:, _LINEAR] @ coefficients(theta)[_LINEAR]
        errors_v = np.tan(self.rad) * self.standard_uncertainty_rad * in_plane_v[:, None]
        symbol = Message("cos τ, as far as τ is known")
        return (Source(name=Message("tilt of the head's axis"), symbol=symbol, errors_v=np.asarray(errors_v)),)


def tilt_found(
    found: Sequence[Found], places: Sequence[slice], coefficients_: FloatArray, deviations: FloatArray | None = None
) -> Tilt:
    """The tilt among coefficients of effects, in degrees there; `deviations` are their standard uncertainties."""
    for item, columns in zip(found, places, strict=True):
        if item.effect.name == _AXIS_TILT:
            uncertain = 0.0 if deviations is None else float(deviations[columns.start])
            return Tilt(
                rad=float(np.deg2rad(coefficients_[columns.start])),
                standard_uncertainty_rad=float(np.deg2rad(uncertain)),
            )
    return Tilt()
