"""An independent least-squares fit of the declared model with any further columns, on the bank's own geometry."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import minimize_scalar

from benchmarks.bank.geometry import AXES, FloatArray, projections
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.observations import Observations

_WIDE_DEG = np.arange(-45.0, 45.1, 5.0)
"""Where alpha0 is looked for; between two of these the sum of squares has no second minimum."""
_NEAR_DEG = 3.0
_RANK = 1e-10


@dataclass(frozen=True, kw_only=True)
class Fit:
    """A best fit."""

    deviance: float
    """n ln(RSS / n): -2 ln L up to a constant of the table."""
    alpha0_deg: float
    linear: FloatArray
    """u0, kx, ky, kz, kxy, then the coefficients of the further columns."""


@dataclass(frozen=True, kw_only=True)
class Table:
    """Rows to fit, with the relative weight of each."""

    observations: Observations
    weights: FloatArray

    @cached_property
    def _functions(self) -> FloatArray:
        """What any alpha0 makes of the declared model: 1, gravity, gravity a quarter turn on, and three products."""
        axes = np.stack([AXES[str(mount)] for mount in self.observations.mounts])
        g = projections(axes, self.observations.angle_deg)
        h = projections(axes, self.observations.angle_deg + 90.0)
        products = (g[:, 0] * g[:, 1], g[:, 0] * h[:, 1] + h[:, 0] * g[:, 1], h[:, 0] * h[:, 1])
        return np.column_stack([np.ones(len(g)), g, h, *products])

    def fit(self, columns: FloatArray, near_deg: float | None = None) -> Fit:
        """Fit with further columns, shape (rows, n); alpha0 is looked for `near_deg`, or everywhere up to 45°."""
        lengths = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
        root = np.sqrt(self.weights)[:, None]
        everything = np.column_stack([self._functions, columns / lengths, self.observations.output_v]) * root
        reduced = np.linalg.qr(everything, mode="r")
        if near_deg is None:
            squares = [_solved(reduced, alpha0_deg)[0] for alpha0_deg in _WIDE_DEG]
            near_deg, reach_deg = float(_WIDE_DEG[np.argmin(squares)]), 5.0
        else:
            reach_deg = _NEAR_DEG
        found = minimize_scalar(
            lambda alpha0_deg: _solved(reduced, alpha0_deg)[0],
            bounds=(near_deg - reach_deg, near_deg + reach_deg),
            method="bounded",
            options={"xatol": 1e-5},
        )
        squares_v2, linear = _solved(reduced, float(found.x))
        rows = len(self.observations)
        linear[5:] /= lengths
        deviance = rows * float(np.log(max(squares_v2, 1e-300) / rows))
        return Fit(deviance=deviance, alpha0_deg=float(found.x), linear=linear)

    def falls_v2(self, scene: Scene, columns: FloatArray, forms: Sequence[FloatArray]) -> list[float]:
        """By how much each form lowers the sum of squares beside the columns, alpha0 linearised at the scene."""
        root = np.sqrt(self.weights)[:, None]
        span = _span(root * np.column_stack([self.free(scene), columns]))
        left_v = root[:, 0] * self.observations.output_v
        left_v = left_v - span @ (span.T @ left_v)
        free = [root * form - span @ (span.T @ (root * form)) for form in forms]
        return [float(np.sum((_span(form).T @ left_v) ** 2)) for form in free]

    def free(self, scene: Scene) -> FloatArray:
        """What the declared model may follow, alpha0 linearised at the scene, shape (rows, 6)."""
        return np.column_stack([self._functions @ _turned(scene.alpha0_deg), scene.slope_v_per_deg])

    def scene(self, columns: FloatArray) -> Scene:
        """What effects see, by the fit with these columns; from alpha0 = 0 where nothing speaks against it."""
        best, held = self.fit(columns), self.fit(columns, near_deg=0.0)
        alpha0_deg = 0.0 if abs(best.alpha0_deg) > 2 * _NEAR_DEG else best.alpha0_deg
        linear = (held if abs(best.alpha0_deg) > 2 * _NEAR_DEG else best).linear[:5]
        above, at, below = (self._functions @ _turned(alpha0_deg + step) @ linear for step in (0.05, 0.0, -0.05))
        return Scene(
            observations=self.observations,
            alpha0_deg=alpha0_deg,
            output_v=at,
            slope_v_per_deg=(above - below) / 0.1,
            response_v_per_g=linear[1:4],
        )

    def side_by_side(self, parts: Sequence[FloatArray]) -> FloatArray:
        """The columns of several effects, shape (rows, n)."""
        return np.column_stack([np.empty((len(self.observations), 0)), *parts])


def _span(columns: FloatArray) -> FloatArray:
    """Orthonormal columns that span the given ones."""
    lengths = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    left, values, _ = np.linalg.svd(columns / lengths, full_matrices=False)
    return np.asarray(left[:, values > _RANK])


def _turned(alpha0_deg: float) -> FloatArray:
    """From u0, kx, ky, kz, kxy to the coefficients of the ten functions, shape (10, 5)."""
    cos, sin = np.cos(np.deg2rad(alpha0_deg)), np.sin(np.deg2rad(alpha0_deg))
    matrix = np.zeros((10, 5))
    matrix[0, 0] = 1.0
    for axis in (1, 2, 3):
        matrix[axis, axis], matrix[axis + 3, axis] = cos, sin
    matrix[7:, 4] = cos**2, cos * sin, sin**2
    return matrix


def _solved(reduced: FloatArray, alpha0_deg: float) -> tuple[float, FloatArray]:
    """Sum of squares and linear parameters at one alpha0."""
    model = np.column_stack([reduced[:, :10] @ _turned(alpha0_deg), reduced[:, 10:-1]])
    linear = np.linalg.lstsq(model, reduced[:, -1], rcond=_RANK)[0]
    left_v = reduced[:, -1] - model @ linear
    return float(left_v @ left_v), linear
