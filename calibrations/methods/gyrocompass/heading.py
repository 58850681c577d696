"""Heading and drift of one set of rates, or of many, in a noise that is known: generalised least squares.

The noise is declared by its Allan coefficients or as a Gauss-Markov process (`expected.DriftNoise`), so that the
covariance of the mean rates is exact. No unbiased estimate has less variance.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.tracing.linearised import directions, orthogonal_to

_CIRCLE: Final = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
_ROUNDS: Final = 12
_LARGEST_STEP: Final = 0.3


@dataclass(frozen=True, kw_only=True)
class Heading:
    """What rates say, each of shape (runs,) or a number."""

    alpha0_deg: FloatArray
    """Above -180 up to 180."""
    drift_deg_h: FloatArray
    covariance: FloatArray
    """Of α0 in degrees and the drift, shape (..., 2, 2): the Cramér-Rao bound at the estimate."""
    chi_square: FloatArray
    """What is left of the rates, in the variances of the noise, shape (runs,) or a number."""

    @property
    def standard_uncertainties(self) -> FloatArray:
        """Of α0 in degrees and of the drift in °/h, shape (..., 2)."""
        return np.asarray(np.sqrt(np.diagonal(self.covariance, axis1=-2, axis2=-1)))


def estimated(
    rate_deg_h: FloatArray,
    delta_rad: FloatArray,
    latitude_deg: FloatArray,
    lean: Lean,
    covariance: FloatArray,
    beside: FloatArray | None = None,
) -> Heading:
    """Heading and drift from mean rates.

    Parameters
    ----------
    rate_deg_h
        Shape (dwells,), or (runs, dwells) of many runs of the same positions.
    delta_rad, latitude_deg, lean
        Pickoff angle, latitude and lean of each dwell.
    covariance
        Of the mean rates, shape (dwells, dwells), in (°/h)².
    beside
        What else the rates hold in sizes that are not known, shape (dwells, n).
    """
    factor = np.linalg.cholesky(covariance)
    functions = heading_functions(delta_rad, latitude_deg, lean)
    white = np.linalg.solve(factor, np.column_stack([functions, np.ones(len(delta_rad))]))
    rates = np.linalg.solve(factor, np.atleast_2d(rate_deg_h).T)
    if beside is not None and beside.size:
        others = directions(np.linalg.solve(factor, beside))
        white, rates = orthogonal_to(others, white), orthogonal_to(others, rates)
    one = white[:, 2] / np.linalg.norm(white[:, 2])
    f, z = white[:, :2] - np.outer(one, one @ white[:, :2]), rates - np.outer(one, one @ rates)
    alpha0 = best_angles(f.T @ f, (f.T @ z).T)
    point = _directions(alpha0)
    drift = (white[:, 2] @ (rates - white[:, :2] @ point.T)) / float(white[:, 2] @ white[:, 2])
    left = rates - white[:, :2] @ point.T - np.outer(white[:, 2], drift)
    found = Heading(
        alpha0_deg=-((-np.rad2deg(alpha0) + 180.0) % 360.0 - 180.0),
        drift_deg_h=drift,
        covariance=_bounds(white, _directions(alpha0 + np.pi / 2)),
        chi_square=np.sum(left**2, axis=0),
    )
    if np.ndim(rate_deg_h) > 1:
        return found
    return Heading(
        alpha0_deg=found.alpha0_deg[0],
        drift_deg_h=found.drift_deg_h[0],
        covariance=found.covariance[0],
        chi_square=found.chi_square[0],
    )


def best_angles(gram: FloatArray, along: FloatArray) -> FloatArray:
    """For each of many vectors b, shape (runs, 2), the angle a of least u'Mu - 2b'u with u = (sin a, cos a)."""
    around = _directions(_CIRCLE)
    curve = np.einsum("ki,ij,kj->k", around, gram, around)
    angle: FloatArray = _CIRCLE[np.argmin(curve - 2.0 * along @ around.T, axis=1)]
    for _ in range(_ROUNDS):
        point, turned = _directions(angle), _directions(angle + np.pi / 2)
        left = point @ gram - along
        straight = np.einsum("ki,ij,kj->k", turned, gram, turned)
        bent = straight - np.einsum("ki,ki->k", point, left)
        step = -np.einsum("ki,ki->k", turned, left) / np.where(bent > 0.0, bent, np.maximum(straight, 1e-300))
        angle = angle + np.clip(step, -_LARGEST_STEP, _LARGEST_STEP)
    return angle


def _directions(angle_rad: FloatArray) -> FloatArray:
    """Sines and cosines, shape (runs, 2)."""
    return np.column_stack([np.sin(angle_rad), np.cos(angle_rad)])


def _bounds(white: FloatArray, turned: FloatArray) -> FloatArray:
    """Inverse of Fisher's information of α0 in degrees and the drift, shape (runs, 2, 2)."""
    slope = np.deg2rad(1.0) * turned @ white[:, :2].T
    information = np.empty((len(turned), 2, 2))
    information[:, 0, 0] = np.einsum("kd,kd->k", slope, slope)
    information[:, 0, 1] = information[:, 1, 0] = slope @ white[:, 2]
    information[:, 1, 1] = float(white[:, 2] @ white[:, 2])
    return np.asarray(np.linalg.inv(information))
