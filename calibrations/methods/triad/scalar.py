"""The scalar fit: nine parameters from |a| = 1 alone, free of every angle of the stand.

Only L Lᵀ = K Kᵀ can be told without a direction, with L lower triangular: the three biases, the lengths of the rows of
K (`norm_i`, V/g) and the angles between them (`orthogonality_ij` = asin(k_i·k_j / |k_i||k_j|), in arc seconds). The
mismatch |L⁻¹(u - b)| - 1 of a dwell has the variance Σ (σ_i (L⁻ᵀ n)_i)² with n the direction of gravity.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD
from tumble.messages import Message

PARAMETERS: Final = 9
NAMES: Final = (
    *(f"bias_{c}" for c in "xyz"),
    *(f"norm_{c}" for c in "xyz"),
    *(f"orthogonality_{pair}" for pair in ("xy", "xz", "yz")),
)
_UNITS: Final = (*["V"] * 3, *["V/g"] * 3, *["arcsec"] * 3)
_LOWER: Final = np.tril_indices(3)
_PAIRS: Final = ((0, 1), (0, 2), (1, 2))
_ROUNDS = 30
_FARTHEST = 10.0
"""A response so many times the range of the outputs fits only where gravity is nowhere as long as it should be."""


@dataclass(frozen=True, kw_only=True)
class Mismatch:
    """|a| - 1 of all dwells by the scalar fit, in arc seconds of the local gravity."""

    each_arcsec: FloatArray
    degrees_of_freedom: int
    """Dwells less the nine parameters."""

    @property
    def mean_arcsec(self) -> float:
        """Mean over the dwells."""
        return float(self.each_arcsec.mean())

    @property
    def standard_deviation_arcsec(self) -> float | None:
        """Root of the sum of squares over the degrees of freedom that are left; None where none is."""
        if self.degrees_of_freedom < 1:
            return None
        return float(np.sqrt(np.sum(self.each_arcsec**2) / self.degrees_of_freedom))

    @property
    def largest_arcsec(self) -> float:
        """Largest size."""
        return float(np.abs(self.each_arcsec).max())


@dataclass(frozen=True, kw_only=True)
class ScalarFit:
    """What |a| = 1 tells of a triad."""

    parameters: dict[str, Parameter]
    mismatch: Mismatch
    bias_v: FloatArray
    lower_v: FloatArray
    """L, volts per g, lower triangular, shape (3, 3)."""


def fit_scalar(outputs_v: FloatArray, variances: FloatArray) -> ScalarFit | None:
    """Fit nine parameters to outputs of shape (dwells, 3); None with fewer than nine dwells or where none converges.

    Parameters
    ----------
    outputs_v
        Outputs of the three channels, in volts.
    variances
        Relative variances of a dwell of each channel, shape (3,).
    """
    if len(outputs_v) < PARAMETERS:
        return None
    theta = _start(outputs_v)
    for _ in range(_ROUNDS):
        mismatch, jacobian, spread = _linearised(theta, outputs_v, variances)
        inverse, _ = pseudo_inverse(jacobian / spread[:, None])
        step = inverse @ (mismatch / spread)
        theta = theta - step
        if not np.isfinite(theta).all():
            return None
        if np.abs(step).max() < 1e-13 * np.abs(theta).max():
            break
    if np.abs(theta[3:]).max() > _FARTHEST * np.ptp(outputs_v):
        return None
    return _stated(theta, outputs_v, variances)


def _start(outputs_v: FloatArray) -> FloatArray:
    """Middle and half of the range of each channel."""
    low, high = outputs_v.min(axis=0), outputs_v.max(axis=0)
    return np.concatenate([(low + high) / 2, np.diag((high - low) / 2)[_LOWER]])


def _unpacked(theta: FloatArray) -> tuple[FloatArray, FloatArray]:
    lower = np.zeros((3, 3))
    lower[_LOWER] = theta[3:]
    return theta[:3], lower


def _linearised(
    theta: FloatArray, outputs_v: FloatArray, variances: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Mismatch of each dwell, its derivative, shape (dwells, 9), and its relative standard deviation."""
    bias_v, lower = _unpacked(theta)
    inverse = np.linalg.inv(lower)
    a = (outputs_v - bias_v) @ inverse.T
    length = np.linalg.norm(a, axis=1)
    back = (a / length[:, None]) @ inverse  # rows of (L⁻ᵀ n)ᵀ
    rows, columns = _LOWER
    jacobian = np.column_stack([-back, -back[:, rows] * a[:, columns]])
    return length - 1.0, jacobian, np.sqrt(back**2 @ variances)


def _stated(theta: FloatArray, outputs_v: FloatArray, variances: FloatArray) -> ScalarFit:
    mismatch, jacobian, spread = _linearised(theta, outputs_v, variances)
    bias_v, lower = _unpacked(theta)
    inverse, told = pseudo_inverse(jacobian / spread[:, None])
    freedom = len(outputs_v) - PARAMETERS
    variance = float(np.sum((mismatch / spread) ** 2)) / max(freedom, 1)
    values = _values(theta)
    slopes = np.column_stack([_slope(theta, place) for place in range(PARAMETERS)])
    uncertainty = np.sqrt(variance * np.sum((slopes @ inverse) ** 2, axis=1))
    factor = coverage_factor(freedom)
    parameters = {}
    for name, unit, value, u in zip(NAMES, _UNITS, values.tolist(), uncertainty.tolist(), strict=True):
        parameters[name] = Parameter(
            name=name,
            unit=unit,
            value=value,
            standard_uncertainty=u,
            type_a=u,
            degrees_of_freedom=float(freedom),
            interval_95=(value - factor * u, value + factor * u),
        )
        if not told.all():
            reason = Message("these positions do not tell all nine parameters of the scalar fit")
            parameters[name] = parameters[name].withheld(reason)
        elif freedom < 1:
            reason = Message("nine dwells leave nothing to judge the scatter by")
            parameters[name] = parameters[name].withheld(reason)
    return ScalarFit(
        parameters=parameters,
        mismatch=Mismatch(each_arcsec=mismatch * ARCSEC_PER_RAD, degrees_of_freedom=freedom),
        bias_v=bias_v,
        lower_v=lower,
    )


def _values(theta: FloatArray) -> FloatArray:
    bias_v, lower = _unpacked(theta)
    norms = np.linalg.norm(lower, axis=1)
    angles = [np.arcsin(lower[i] @ lower[j] / (norms[i] * norms[j])) for i, j in _PAIRS]
    return np.concatenate([bias_v, norms, ARCSEC_PER_RAD * np.array(angles)])


def _slope(theta: FloatArray, place: int) -> FloatArray:
    """Derivative of the stated values with one of the internal ones, by central differences."""
    step = 1e-6 * max(float(np.abs(theta[3:]).max()), 1e-12)
    above, below = theta.copy(), theta.copy()
    above[place] += step
    below[place] -= step
    return np.asarray((_values(above) - _values(below)) / (2 * step))
