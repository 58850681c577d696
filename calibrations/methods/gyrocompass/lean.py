"""How each base leans, by the tilts that the platform measured at its positions.

The outer axis of the turntable stands off the vertical, so that the tilt of the levelled platform follows the pickoff
angle δ: `sin γ = A cos δ + B sin δ + bias`. A and B are sines of the tilts at 0 and at 90°; three positions of a base
show the bias of the sensor too.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations

_HUBER = 1.345
"""Tuning of Huber's weights: 95% efficient on normal noise (Huber and Ronchetti, Robust Statistics, 4.5)."""
_ROUNDS = 20
_MOST = 0.9
"""Sine of a lean beyond which no platform works: these are no tilts at these angles, which is asked about."""


@dataclass(frozen=True, kw_only=True)
class Lean:
    """The lean of each row's base, arrays of shape (rows,)."""

    cosine: FloatArray
    """A: sine of the tilt at pickoff angle 0."""
    sine: FloatArray
    """B: sine of the tilt at pickoff angle 90°."""

    def sin_tilt(self, delta_rad: FloatArray) -> FloatArray:
        """Sine of the tilt γ at pickoff angles, shape (rows,)."""
        return np.asarray(self.cosine * np.cos(delta_rad) + self.sine * np.sin(delta_rad))

    def over(self, rows: NDArray[np.int64]) -> "Lean":
        """The lean of these rows, by number."""
        return Lean(cosine=self.cosine[rows], sine=self.sine[rows])


def leans(observations: GyrocompassObservations) -> Lean:
    """Lean of the base of each row, by a robust fit to the tilts of that base; none where the table has no tilts."""
    count = len(observations)
    cosine, sine = np.zeros(count), np.zeros(count)
    if observations.tilt_gamma_deg is None:
        return Lean(cosine=cosine, sine=sine)
    delta, tilt = np.deg2rad(observations.azimuth_deg), np.sin(np.deg2rad(observations.tilt_gamma_deg))
    for number in np.unique(observations.bases).tolist():
        its = observations.bases == number
        fitted = _fitted(delta[its], tilt[its])
        cosine[its], sine[its] = fitted if float(np.linalg.norm(fitted)) < _MOST else (0.0, 0.0)
    return Lean(cosine=cosine, sine=sine)


def _fitted(delta_rad: FloatArray, sin_tilt: FloatArray) -> FloatArray:
    """A and B of one base by Huber's M-estimate."""
    columns = [np.cos(delta_rad), np.sin(delta_rad)]
    if len(np.unique(np.round(np.rad2deg(delta_rad) % 360.0, 2) % 360.0)) > len(columns):
        columns.append(np.ones(len(delta_rad)))
    design = np.column_stack(columns)
    root: FloatArray = np.ones(len(delta_rad))
    found: FloatArray = np.zeros(design.shape[1])
    for _ in range(_ROUNDS):
        found = np.asarray(np.linalg.lstsq(design * root[:, None], sin_tilt * root, rcond=1e-9)[0])
        size = np.abs(sin_tilt - design @ found)
        limit = _HUBER * max(float(1.4826 * np.median(size)), 1e-12)
        root = np.asarray(np.sqrt(np.minimum(1.0, limit / np.maximum(size, limit))))
    return np.asarray(found[:2])
