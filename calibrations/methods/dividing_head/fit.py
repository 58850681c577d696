"""One joint weighted fit of all rows: flips, sweeps, mounts and realisations together."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.dividing_head.best_alpha0 import (
    ALPHA0_REACH_DEG,
    GRID_DEG,
    DeclaredAlone,
    best_parameters,
    declared_alone,
)
from tumble.calibrations.methods.dividing_head.conditional import conditional
from tumble.calibrations.methods.dividing_head.model import (
    ALPHA0,
    PARAMETERS,
    coefficients,
    coefficients_jacobian,
    parameter_vector,
)

_NODES = np.linspace(-6.0, 6.0, 49)


@dataclass(frozen=True, kw_only=True)
class JointFit:
    """Least-squares parameters of the declared model, identifiable or not."""

    theta: FloatArray
    """Parameter vector in the order and units of `model.UNITS`, then the coefficients of further columns.

    alpha0 is what it was held at where it is not fitted.
    """
    alpha0_fitted: bool
    squares_v2: float
    """Weighted sum of squared residuals, in square volts."""
    jacobian: FloatArray
    """Derivative of the rotated voltages, shape (10 + terms, 6 + terms); zero for an alpha0 that is not fitted."""
    inverse: FloatArray
    """Pseudo-inverse of `jacobian`, shape (6 + terms, 10 + terms): what an error in z does to the parameters."""
    estimable: NDArray[np.bool_]
    """Which parameters the rows determine at this solution, shape (6 + terms,)."""

    @property
    def fitted(self) -> int:
        """Number of independent parameter combinations that the rows determine."""
        return int(np.linalg.matrix_rank(self.inverse))


def joint_fit(compressed: Compressed) -> JointFit:
    """Fit all parameters."""
    return _solution(compressed, best_parameters(compressed), True)


def squares_v2(compressed: Compressed, theta: FloatArray) -> float:
    """Weighted sum of squared residuals, in square volts."""
    misfit = compressed.z - compressed.r @ coefficients(theta)
    return compressed.rest_v2 + float(misfit @ misfit)


def fit_given_alpha0(compressed: Compressed, alpha0_deg: float) -> JointFit:
    """Fit the linear parameters with alpha0 held."""
    linear = conditional(compressed, np.array([alpha0_deg])).linear[0]
    return _solution(compressed, parameter_vector(linear, alpha0_deg), False)


def _solution(compressed: Compressed, theta: FloatArray, alpha0_fitted: bool) -> JointFit:
    jacobian, inverse, estimable = _inverse(compressed, theta, alpha0_fitted)
    return JointFit(
        theta=theta,
        alpha0_fitted=alpha0_fitted,
        squares_v2=squares_v2(compressed, theta),
        jacobian=jacobian,
        inverse=inverse,
        estimable=estimable,
    )


def _inverse(
    compressed: Compressed, theta: FloatArray, alpha0_fitted: bool
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    jacobian = compressed.r @ coefficients_jacobian(theta)
    if not alpha0_fitted:
        jacobian[:, ALPHA0] = 0.0
    return jacobian, *pseudo_inverse(jacobian)


@dataclass(frozen=True, kw_only=True)
class Alpha0Profile:
    """How the misfit grows as alpha0 leaves its best value, and what that says of all parameters."""

    interval_deg: tuple[float, float]
    """95% interval: where the sum of squares exceeds its minimum by less than the variance times t squared."""
    identifiable: bool
    """False where the interval reaches the end of alpha0's range: it is not identifiable."""
    within_deg: FloatArray
    """Values of alpha0 that the interval contains, its ends included, for looking at what they imply."""

    def nodes_deg(self, centre_deg: float) -> FloatArray:
        """Values of alpha0 a quarter of a standard uncertainty apart, six of them to either side of the centre."""
        low, high = self.interval_deg
        spread = np.where(_NODES < 0, centre_deg - low, high - centre_deg) / 2.0
        return np.clip(centre_deg + _NODES * spread, -ALPHA0_REACH_DEG, ALPHA0_REACH_DEG)


def alpha0_profile(compressed: Compressed, fit: JointFit, variance_v2: float, factor: float) -> Alpha0Profile:
    """Profile-likelihood interval of alpha0 (Bates and Watts, Nonlinear Regression, 6.1.2).

    `variance_v2` is the variance of a row of weight 1, `factor` the Student factor.
    """
    if not np.isfinite(factor):
        return Alpha0Profile(
            interval_deg=(-ALPHA0_REACH_DEG, ALPHA0_REACH_DEG), identifiable=False, within_deg=GRID_DEG
        )
    limit = fit.squares_v2 + variance_v2 * factor**2
    rows = declared_alone(compressed)
    centre = float(fit.theta[ALPHA0])
    accepted = rows.least_v2(GRID_DEG) <= limit
    identifiable = not (accepted[0] or accepted[-1]) and abs(centre) < ALPHA0_REACH_DEG and bool(fit.estimable[ALPHA0])
    reach = 3 * factor * float(np.sqrt(variance_v2 * (fit.inverse @ fit.inverse.T)[ALPHA0, ALPHA0]))
    low, high = (_crossing(rows, centre, side * reach, limit) for side in (-1.0, 1.0))
    within = np.concatenate([np.linspace(low, high, 21), GRID_DEG[accepted]])
    if low < 0.0 < high:
        within = np.append(within, 0.0)
    return Alpha0Profile(interval_deg=(low, high), identifiable=identifiable, within_deg=within)


def _crossing(rows: DeclaredAlone, centre_deg: float, reach_deg: float, limit_v2: float) -> float:
    """Where the sum of squares first reaches the limit, looking from the centre in the direction of `reach_deg`.

    That is where a normal likelihood has long passed it; where this one has not, the whole range is searched. Its end
    is the answer where the limit is not reached at all.
    """
    end_deg = float(np.copysign(ALPHA0_REACH_DEG, reach_deg))
    near_deg = float(np.clip(centre_deg + reach_deg, -ALPHA0_REACH_DEG, ALPHA0_REACH_DEG))
    passed = rows.least_v2(np.array([near_deg]))[0] > limit_v2
    inside_deg, outside_deg = centre_deg, near_deg if passed else end_deg
    for _ in range(5):
        ladder = np.linspace(inside_deg, outside_deg, 17)
        beyond = rows.least_v2(ladder) > limit_v2
        if not beyond.any():
            return end_deg
        first = max(int(np.argmax(beyond)), 1)
        inside_deg, outside_deg = float(ladder[first - 1]), float(ladder[first])
    return outside_deg


def covariance(compressed: Compressed, fit: JointFit, profile: Alpha0Profile, variance_v2: float) -> FloatArray:
    """Covariance of all parameters, shape (6 + terms, 6 + terms), in the units of `model.UNITS`.

    Where alpha0 is fitted it is integrated over: the others are normal for given alpha0, and alpha0 is weighted by the
    likelihood of its profile. For a sharp alpha0 this is the usual inverse of the normal matrix; for a blunt one it
    holds the curvature that a linearisation loses (kx changes with the square of alpha0).
    """
    linearised = variance_v2 * fit.inverse @ fit.inverse.T
    if not fit.alpha0_fitted:
        return np.asarray(linearised)
    nodes = profile.nodes_deg(float(fit.theta[ALPHA0]))
    each = conditional(compressed, nodes)
    weight = np.exp(-0.5 * (each.squares_v2 - fit.squares_v2) / variance_v2) * np.gradient(nodes)
    weight /= weight.sum()
    shift = parameter_vector(each.linear, nodes) - fit.theta
    result = np.einsum("n,ni,nj->ij", weight, shift, shift)
    others = np.delete(np.arange(len(fit.theta)), ALPHA0)
    result[np.ix_(others, others)] += variance_v2 * np.einsum("n,nij->ij", weight, each.cofactor)
    return np.asarray(result)


def names(mask: NDArray[np.bool_]) -> tuple[str, ...]:
    """Names of the parameters at which `mask`, shape (6,), is true."""
    return tuple(name for name, selected in zip(PARAMETERS, mask, strict=False) if selected)
