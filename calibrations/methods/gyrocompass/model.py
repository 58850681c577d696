"""Heading and drift, and the lean of each base, as tracing sees them.

Rows are those of `table`: the rate of a dwell, then its tilt. The first three functions have the coefficients sin α0,
cos α0 and the drift; the others are the lean of each base, which the tilts tell. The output is what the earth rate at
an anchor leaves, an α0 near the true one: then a small change of the model is a small change of α0, as tracing takes it
for granted. Without an anchor the circle is searched whole, so that no start decides which of several minima is taken.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import SINGULAR, smallest_solution

ALPHA0, DRIFT = 0, 1
HEADING: Final = 2
"""Functions that α0 multiplies by its sine and cosine."""
NAMES: Final = ("alpha0", "drift")
UNITS: Final = {"alpha0": "deg", "drift": "°/h"}
_CIRCLE: Final = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
_AROUND: Final = np.stack([np.sin(_CIRCLE), np.cos(_CIRCLE)])
_ROUNDS = 12


@dataclass(frozen=True, kw_only=True)
class Gyrocompass:
    """The model: three functions and those of the leans, α0 nonlinear."""

    functions: FloatArray
    anchor_rad: float | None = None
    """α0 whose earth rate is taken off the output, and from which it is looked for; None where nothing is."""

    @property
    def parameters(self) -> int:
        """α0 in radians, drift, and the sines of two tilts of each base."""
        return int(self.functions.shape[1]) - 1

    @property
    def _taken_off(self) -> FloatArray:
        """Coefficients of what is taken off the output."""
        return np.zeros(HEADING) if self.anchor_rad is None else direction(self.anchor_rad)

    def fitted(self, compressed: Compressed) -> FloatArray:
        """By profile: for each α0 the rest is linear."""
        heading, others = compressed.r[:, :HEADING], compressed.r[:, HEADING:]
        whole = compressed.z + heading @ self._taken_off
        alpha0_rad = best_angle(*beside(others, heading, whole), self.anchor_rad)
        rest = smallest_solution(others, whole - heading @ direction(alpha0_rad))
        return np.concatenate([[alpha0_rad], rest])

    def near(self, compressed: Compressed) -> FloatArray:
        """As fitted."""
        return self.fitted(compressed)

    def coefficients(self, theta: FloatArray) -> FloatArray:
        """Coefficients of the functions, and of any further columns, of one set of parameters or of many."""
        alpha0_rad = theta[..., :1]
        heading = np.concatenate([np.sin(alpha0_rad), np.cos(alpha0_rad)], axis=-1) - self._taken_off
        return np.concatenate([heading, theta[..., 1:]], axis=-1)

    def slopes(self, theta: FloatArray) -> FloatArray:
        """Derivative of the coefficients of the functions, shape (functions, parameters)."""
        found = np.zeros((self.parameters + 1, self.parameters))
        found[:HEADING, ALPHA0] = np.cos(theta[ALPHA0]), -np.sin(theta[ALPHA0])
        found[HEADING:, DRIFT:] = np.eye(self.parameters - 1)
        return found

    def with_functions(self, functions: FloatArray) -> "Gyrocompass":
        """The same for other rows, or for rows that are weighted and turned."""
        return replace(self, functions=functions)


def direction(alpha0_rad: float) -> FloatArray:
    """Sine and cosine of α0, shape (2,)."""
    return np.array([np.sin(alpha0_rad), np.cos(alpha0_rad)])


def beside(others: FloatArray, columns: FloatArray, output: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Columns and output as what is orthogonal to other columns sees them."""
    length = np.linalg.norm(others, axis=0)
    left, values, _ = np.linalg.svd(others / np.where(length > 0.0, length, 1.0), full_matrices=False)
    taken = left[:, values > SINGULAR * values.max(initial=1.0)]
    return columns - taken @ (taken.T @ columns), output - taken @ (taken.T @ output)


def best_angle(f: FloatArray, z: FloatArray, near_rad: float | None = None) -> float:
    """The angle a for which f (sin a, cos a) is nearest to z, by Newton's method; over the whole circle without one."""
    gram, along = f.T @ f, f.T @ z
    angle = float(_CIRCLE[np.argmin(_misfits(gram, along))]) if near_rad is None else near_rad
    for _ in range(_ROUNDS):
        step = _newton(gram, along, angle)
        angle += step
        if abs(step) < 1e-14:
            break
    return angle


def _misfits(gram: FloatArray, along: FloatArray) -> FloatArray:
    """Sum of squares over the circle, up to a constant."""
    return np.asarray(np.sum(_AROUND * (gram @ _AROUND), axis=0) - 2.0 * along @ _AROUND)


def _newton(gram: FloatArray, along: FloatArray, angle: float) -> float:
    """A step towards the minimum of the sum of squares; Gauss and Newton's where that is not curved upwards."""
    point, turned = direction(angle), direction(angle + np.pi / 2)
    slope = float(turned @ (gram @ point - along))
    straight = float(turned @ gram @ turned)
    curvature = straight - float(point @ (gram @ point - along))
    bent = curvature if curvature > 0.0 else straight
    return 0.0 if bent <= 0.0 else float(np.clip(-slope / bent, -0.3, 0.3))
