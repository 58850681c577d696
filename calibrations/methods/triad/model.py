"""The fourteen parameters of a triad on a two-axis stand.

The output of channel i is `u_i = bias_i + scale_i (a_i + Σ m_ij a_j)` with gravity a of `geometry`. Inside, the nine
products `K_ij = scale_i m_ij` (m_ii = 1) and the two levels stand for scales and angles: u = bias + K a, exactly.
Rows are those of channels x, y, z of each dwell in turn.
"""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import smallest_solution
from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD, Directions

INTERNAL: Final = 14
"""Three biases, the nine numbers of K by rows, the two levels in radians."""
FUNCTIONS: Final = 30
"""Of each channel one constant, then the three directions with three components each."""
LEVEL_X, LEVEL_Y = 12, 13
NAMES: Final = (
    *(f"bias_{c}" for c in "xyz"),
    *(f"scale_{c}" for c in "xyz"),
    "m_xy",
    "m_xz",
    "m_yx",
    "m_yz",
    "m_zx",
    "m_zy",
    "level_x",
    "level_y",
)
UNITS: Final = {
    name: "V" if name.startswith("bias") else "V/g" if name.startswith("scale") else "arcsec" for name in NAMES
}
_ROUNDS = 8


def functions(directions: Directions) -> FloatArray:
    """Functions of the positions for all channels, x, y, z of each dwell in turn, shape (3 rows, 30)."""
    rows = len(directions.level)
    one = np.column_stack([np.ones(rows), directions.level, directions.outer, directions.along])
    found = np.zeros((rows, 3, 3, one.shape[1]))
    for channel in range(3):
        found[:, channel, channel] = one
    return found.reshape(3 * rows, -1)


def response(theta: FloatArray) -> FloatArray:
    """K: volts of each channel (rows) per g along each axis of the case, shape (..., 3, 3) of parameters (..., n)."""
    return np.asarray(theta[..., 3:12].reshape(*theta.shape[:-1], 3, 3))


@dataclass(frozen=True, kw_only=True)
class Triad:
    """The model as tracing sees it: thirty functions, fourteen parameters, the levels nonlinear."""

    functions: FloatArray

    @property
    def parameters(self) -> int:
        """Biases, K, levels."""
        return INTERNAL

    def fitted(self, compressed: Compressed) -> FloatArray:
        """By Gauss-Newton from nothing at all: the first round gives K on a level stand, some more the levels."""
        terms = compressed.r.shape[1] - FUNCTIONS
        theta = np.zeros(INTERNAL + terms)
        for _ in range(_ROUNDS):
            misfit = compressed.z - compressed.r @ self.coefficients(theta)
            step = smallest_solution(compressed.r @ self._slopes(theta), misfit)
            theta = theta + step
            if np.abs(step[LEVEL_X : LEVEL_Y + 1]).max() < 1e-13 and np.abs(step).max() < 1e-12 * np.abs(theta).max():
                break
        return theta

    def near(self, compressed: Compressed) -> FloatArray:
        """As fitted: the levels are small."""
        return self.fitted(compressed)

    def coefficients(self, theta: FloatArray) -> FloatArray:
        """Coefficients of the functions, and of any further columns, of one set of parameters or of many."""
        by_direction = [level[..., None, None] * response(theta) for level in _levels(theta)]
        own = np.concatenate([theta[..., :3, None], *by_direction], axis=-1)
        return np.concatenate([own.reshape(*theta.shape[:-1], FUNCTIONS), theta[..., INTERNAL:]], axis=-1)

    def slopes(self, theta: FloatArray) -> FloatArray:
        """Derivative of the coefficients of the functions, shape (30, 14)."""
        level, outer, along = _levels(theta)
        found = np.zeros((3, 10, INTERNAL))
        for channel in range(3):
            found[channel, 0, channel] = 1.0
            for axis in range(3):
                found[channel, [1 + axis, 4 + axis, 7 + axis], 3 + 3 * channel + axis] = (level, outer, along)
        k, y = response(theta), theta[LEVEL_Y]
        found[:, 1:4, LEVEL_X], found[:, 4:7, LEVEL_X] = -outer * k, level * k
        tangent = np.tan(y)
        found[:, 1:4, LEVEL_Y], found[:, 4:7, LEVEL_Y] = -tangent * level * k, -tangent * outer * k
        found[:, 7:10, LEVEL_Y] = np.cos(y) * k
        return found.reshape(FUNCTIONS, INTERNAL)

    def _slopes(self, theta: FloatArray) -> FloatArray:
        """The same with further columns, shape (30 + terms, 14 + terms)."""
        terms = len(theta) - INTERNAL
        whole = np.zeros((FUNCTIONS + terms, INTERNAL + terms))
        whole[:FUNCTIONS, :INTERNAL] = self.slopes(theta)
        whole[FUNCTIONS:, INTERNAL:] = np.eye(terms)
        return whole

    def with_functions(self, functions: FloatArray) -> "Triad":
        """The same for other rows, or for rows that are weighted and turned."""
        return replace(self, functions=functions)


def _levels(theta: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Coefficients of the three directions by the levels."""
    x, y = theta[..., LEVEL_X], theta[..., LEVEL_Y]
    return np.asarray(np.cos(y) * np.cos(x)), np.asarray(np.cos(y) * np.sin(x)), np.asarray(np.sin(y))


def stated(theta: FloatArray) -> FloatArray:
    """Parameters as they are stated, shape (..., 14): biases, scales, six m and two levels in arcsec."""
    k = response(theta)
    scale = np.diagonal(k, axis1=-2, axis2=-1)
    angles = (k / _divisors(k)[..., None])[..., ~np.eye(3, dtype=bool)]
    turned = ARCSEC_PER_RAD * np.concatenate([angles, theta[..., LEVEL_X : LEVEL_Y + 1]], axis=-1)
    return np.concatenate([theta[..., :3], scale, turned], axis=-1)


def stated_slopes(theta: FloatArray) -> FloatArray:
    """Derivative of `stated`, shape (14, 14)."""
    k = response(theta)
    by = _divisors(k)
    found = np.zeros((INTERNAL, INTERNAL))
    found[:3, :3] = np.eye(3)
    place = 6
    for i in range(3):
        found[3 + i, 3 + 4 * i] = 1.0
        for j in (j for j in range(3) if j != i):
            found[place, 3 + 3 * i + j] = ARCSEC_PER_RAD / by[i]
            found[place, 3 + 4 * i] = -ARCSEC_PER_RAD * k[i, j] / by[i] ** 2
            place += 1
    found[12, LEVEL_X] = found[13, LEVEL_Y] = ARCSEC_PER_RAD
    return found


def _divisors(k: FloatArray) -> FloatArray:
    """The diagonal of K; infinite where no position shows it, so that what rests on it vanishes."""
    scale = np.diagonal(k, axis1=-2, axis2=-1)
    return np.where(scale == 0.0, np.inf, scale)
