"""The best alpha0 of the declared model: a scan of its range, then the zero of the slope of what is left.

For given alpha0 everything else is linear (variable projection, Golub and Pereyra 1973), so that the sum of squares is
a function of alpha0 alone, and a minimum is found for certain where Gauss-Newton would creep or stop halfway: an effect
that is missing from the model may move alpha0 by tens of degrees.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import (
    SINGULAR,
    least_solution,
    left_beside,
    quick_pseudo_inverse,
    smallest_solution,
)
from tumble.calibrations.methods.dividing_head.model import (
    BASIS_SIZE,
    PARAMETERS,
    TERMS,
    coefficients,
    design,
    design_slope,
    further_terms,
    parameter_vector,
    turns,
    turns_and_slopes,
)

ALPHA0_REACH_DEG = 45.0
"""Beyond this the declared model repeats itself with the axes renamed."""
GRID_DEG = np.linspace(-ALPHA0_REACH_DEG, ALPHA0_REACH_DEG, 37)
_RIDGE = 1e-13
"""Part of the trace that keeps the normal equations of the scan solvable where rows do not tell a parameter."""
_FUNCTIONS_OF_EACH = (0, 1, 3, 5, 7)
"""Where those of the ten functions begin that belong to each linear parameter."""
_GRID_TURNS = turns(GRID_DEG)
_GRID_PRODUCTS = (_GRID_TURNS[:, :, None] * _GRID_TURNS[:, None, :]).reshape(len(GRID_DEG), -1)
_RAD_PER_DEG = np.pi / 180.0
_STEPS = 60
_CONVERGED = 1e-12
"""A step that changes the sum of squares by less than this part is the last."""


def best_parameters(compressed: Compressed) -> FloatArray:
    """Parameters of the declared model that leave least, then the coefficients of further columns, to be stated."""
    return _best(compressed, DeclaredAlone.at)


def quick_parameters(compressed: Compressed) -> FloatArray:
    """The same but for rounding, in half the time: to be compared with others, as a search does."""
    return _best(compressed, DeclaredAlone.quickly_at)


def _best(compressed: Compressed, solve: "_Solve") -> FloatArray:
    seen = _seen(compressed)
    rows = _beside(compressed, seen)
    best = _zero_of_slope(partial(solve, rows), *_bracket(rows))
    theta = np.zeros(len(PARAMETERS) + further_terms(compressed))
    theta[: len(PARAMETERS)] = parameter_vector(best.linear, best.alpha0_deg)
    if len(seen):
        left = compressed.z - compressed.r @ coefficients(theta)
        theta[seen + len(PARAMETERS) - BASIS_SIZE] = smallest_solution(compressed.r[:, seen], left)
    return theta


@dataclass(frozen=True, kw_only=True)
class DeclaredAlone:
    """Rotated rows that see the declared model only."""

    r: FloatArray
    """Shape (n, 10)."""
    z: FloatArray
    """Shape (n,), in volts."""
    rest_v2: float
    length: FloatArray
    """Shape (5,): what the rows show of each linear parameter at most, further columns or not."""

    def at(self, alpha0_deg: float) -> "_Least":
        """The best linear parameters at an alpha0; of those that fit equally well the smallest."""
        shapes = design(alpha0_deg)
        linear = np.linalg.lstsq(self.r @ shapes / self.length, self.z, rcond=SINGULAR)[0] / self.length
        left = self.z - self.r @ (shapes @ linear)
        turning = self.r @ (design_slope(alpha0_deg) @ linear)
        return self._least(alpha0_deg, linear, left, turning)

    def quickly_at(self, alpha0_deg: float) -> "_Least":
        """The same but for rounding."""
        matrix, slopes = (turns_and_slopes(alpha0_deg) @ self._terms).reshape(2, len(self.z), -1)
        linear = least_solution(matrix / self.length, self.z) / self.length
        return self._least(alpha0_deg, linear, self.z - matrix @ linear, _RAD_PER_DEG * (slopes @ linear))

    def _least(self, alpha0_deg: float, linear: FloatArray, left: FloatArray, turning: FloatArray) -> "_Least":
        return _Least(
            alpha0_deg=alpha0_deg,
            linear=linear,
            slope=-float(left @ turning),
            squares_v2=float(left @ left) + self.rest_v2,
        )

    @cached_property
    def _terms(self) -> FloatArray:
        """What the rows see of each of the terms of the design, shape (6, n x 5)."""
        return np.asarray((self.r @ TERMS).reshape(len(TERMS), -1))

    def least_v2(self, alpha0_deg: FloatArray) -> FloatArray:
        """The least sum of squares at each alpha0, shape (n,), in square volts."""
        matrices = (turns(alpha0_deg) @ self._terms).reshape(len(alpha0_deg), len(self.z), -1) / self.length
        linear = quick_pseudo_inverse(matrices)[0] @ self.z
        left = self.z - (matrices @ linear[..., None])[..., 0]
        return np.asarray(np.sum(left**2, axis=-1) + self.rest_v2)

    def scanned(self) -> FloatArray:
        """What of the sum of squares the model takes at every alpha0 of the grid, shape (37,)."""
        shown = np.swapaxes(self._terms.reshape(len(TERMS), len(self.z), -1), 0, 1)
        count, size = shown.shape[1:]
        flat = shown.reshape(-1, count * size)
        products = np.swapaxes((flat.T @ flat).reshape(count, size, count, size), 1, 2).reshape(count**2, size**2)
        normal = (_GRID_PRODUCTS @ products).reshape(-1, size, size)
        ridge = _RIDGE * (float(np.sum(self.r**2)) or 1.0) * np.eye(size)  # further columns may take all
        right = _GRID_TURNS @ (self.z @ flat).reshape(count, size)
        return np.asarray(np.sum(right * np.linalg.solve(normal + ridge, right[..., None])[..., 0], axis=-1))


@dataclass(frozen=True, kw_only=True)
class _Least:
    """The least that the declared model leaves at an alpha0."""

    alpha0_deg: float
    linear: FloatArray
    """Shape (5,)."""
    slope: float
    """Half the derivative of the sum of squares, per degree."""
    squares_v2: float


_Solve = Callable[[DeclaredAlone, float], _Least]


def declared_alone(compressed: Compressed) -> DeclaredAlone:
    """Take out whatever further columns can follow."""
    return _beside(compressed, _seen(compressed))


def _beside(compressed: Compressed, seen: NDArray[np.int64]) -> DeclaredAlone:
    """The same where it is known which further columns the rows see."""
    r, z, further = compressed.r[:, :BASIS_SIZE], compressed.z, compressed.r[:, seen]
    squares = np.add.reduceat(np.sum(r**2, axis=0), _FUNCTIONS_OF_EACH)
    length = np.sqrt(np.where(squares > SINGULAR**2 * squares.max(), squares, np.inf))
    if further.size:
        beside = left_beside(further / np.linalg.norm(further, axis=0), np.column_stack([r, z]))
        r, z = beside[:, :-1], beside[:, -1]
    return DeclaredAlone(r=r, z=z, rest_v2=compressed.rest_v2, length=length)


def _seen(compressed: Compressed) -> NDArray[np.int64]:
    """Places of the further columns that the rows see."""
    norm = np.linalg.norm(compressed.r, axis=0)
    return BASIS_SIZE + np.flatnonzero(norm[BASIS_SIZE:] > SINGULAR * norm.max())


def _bracket(rows: DeclaredAlone) -> tuple[float, float]:
    """The neighbours of the best alpha0 of the grid."""
    best = int(np.argmax(rows.scanned()))
    return float(GRID_DEG[max(best - 1, 0)]), float(GRID_DEG[min(best + 1, len(GRID_DEG) - 1)])


def _zero_of_slope(solved: Callable[[float], _Least], low: float, high: float) -> _Least:
    """Where the slope changes from falling to rising: by secants that keep to the bracket (Illinois), else by halving.

    The end of the reach where it only falls, or only rises.
    """
    least = solved(low)
    at_low, at_high, fell = least.slope, solved(high).slope, 0
    for _ in range(_STEPS):
        crossing = low - at_low * (high - low) / (at_high - at_low) if at_low < 0.0 < at_high else low
        least = solved(crossing if low < crossing < high else (low + high) / 2)
        if abs(least.slope) * (high - low) < _CONVERGED * least.squares_v2:
            break
        if least.slope > 0.0:
            high, at_high, at_low = least.alpha0_deg, least.slope, at_low / (2 if fell > 0 else 1)
        else:
            low, at_low, at_high = least.alpha0_deg, least.slope, at_high / (2 if fell < 0 else 1)
        fell = 1 if least.slope > 0.0 else -1
    return least
