"""What errors of the azimuth do beyond the first order: taken off the output once they are known.

Effects are linear in their coefficients. A pickoff error of a degree on a base that leans by some degrees moves the
tilts by hundreds of their standard deviations, and what is of second order in it by several.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.effects.turntable import TURNTABLE_EFFECTS
from tumble.calibrations.methods.gyrocompass.fit import GyrocompassFit
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, NAMES, direction
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.quantified import form_in

_OF_AZIMUTH: Final = frozenset(effect.name for effect in TURNTABLE_EFFECTS)


@dataclass(frozen=True, kw_only=True)
class AngleScene(GyrocompassScene):
    """Dwells whose rows are angles: what an effect adds is the error of the azimuth itself, in radians."""

    @property
    def rate_slope(self) -> FloatArray:
        """One."""
        return np.ones(self.dwells)

    def turned(self, angle_rad: FloatArray) -> FloatArray:
        """The angles, for rates and tilts."""
        return self.in_rows(angle_rad, angle_rad)


def beyond_first_order(scene: GyrocompassScene, fit: GyrocompassFit) -> FloatArray:
    """What the azimuth errors that were found add to the rows beyond the first order, shape (rows,)."""
    error_rad = _errors_rad(scene, fit)
    if not error_rad.any():
        return np.zeros(scene.rows)
    of_rates, of_tilts = error_rad.reshape(scene.dwells, -1)[:, 0], error_rad.reshape(scene.dwells, -1)[:, -1]
    rate = _earth(scene, of_rates, fit) - scene.earth_deg_h - scene.rate_slope * of_rates
    tilt = scene.lean.sin_tilt(scene.delta_rad + of_tilts) - scene.sin_tilt
    return scene.in_rows(rate, tilt - scene.lean.sin_tilt(scene.delta_rad + np.pi / 2) * of_tilts)


def _earth(scene: GyrocompassScene, error_rad: FloatArray, fit: GyrocompassFit) -> FloatArray:
    shown = heading_functions(scene.delta_rad + error_rad, scene.observations.latitude_deg, scene.lean)
    return np.asarray(shown @ direction(float(fit.theta[ALPHA0])))


def _errors_rad(scene: GyrocompassScene, fit: GyrocompassFit) -> FloatArray:
    """Errors of the azimuth by what was found, shape (rows,)."""
    plain = AngleScene(**{name: getattr(scene, name) for name in scene.__dataclass_fields__})
    total = np.zeros(scene.rows)
    for item, columns in zip(fit.found, fit.columns, strict=True):
        if item.effect.name in _OF_AZIMUTH:
            total += form_in(plain, item).columns @ fit.coefficients[columns]
    return total


def lean_of(scene: GyrocompassScene, fit: GyrocompassFit) -> Lean:
    """The lean of each row's base by a fit; as it was where tilts are no rows."""
    leans = fit.theta[len(NAMES) :].reshape(2, -1)
    if not leans.size:
        return scene.lean
    cosine, sine = leans[:, scene.observations.bases]
    return Lean(cosine=cosine, sine=sine)
