"""The declared model of one accelerometer on a dividing head.

`u = u0 + kx ax + ky ay + kz az + kxy ax ay` with the projections of gravity taken at head angle + alpha0
(Avrutov, Bondar, Meleshko 2008, equations 1 and 12). Because a turn by alpha0 mixes each projection with the one a
quarter turn further on, the model is a fixed set of ten functions of the pose times coefficients that depend on the
parameters: all that is nonlinear sits in alpha0.
"""

import math
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.calibrations.methods.dividing_head.observations import Observations

UNITS: Final = {"u0": "V", "kx": "V/g", "ky": "V/g", "kz": "V/g", "kxy": "V/g^2", "alpha0": "deg"}
"""Unit of every parameter, in the order of the parameter vector. g is local gravity."""

PARAMETERS: Final = tuple(UNITS)
LINEAR: Final = PARAMETERS[:-1]
"""The parameters in which the model is linear once alpha0 is known."""
ALPHA0: Final = PARAMETERS.index("alpha0")

BASIS_SIZE: Final = 10
_STRAIGHT, _TURNED = slice(1, 7, 2), slice(2, 7, 2)
"""The three projections among the ten functions, and the same a quarter turn further on."""


def basis(observations: Observations) -> FloatArray:
    """The ten functions of the pose at each row, shape (rows, 10).

    1; then each projection at alpha0 = 0 and the same a quarter turn further on; then the three products by which
    ax ay turns with alpha0.
    """
    p = projections(observations.mounts, observations.true_angle_deg)
    q = projections(observations.mounts, observations.true_angle_deg + 90.0)
    return np.column_stack(
        [
            np.ones(len(observations)),
            *(column for axis in range(3) for column in (p[:, axis], q[:, axis])),
            p[:, 0] * p[:, 1],
            p[:, 0] * q[:, 1] + q[:, 0] * p[:, 1],
            q[:, 0] * q[:, 1],
        ]
    )


def _terms() -> FloatArray:
    """What a linear parameter adds to each coefficient with each of `turns`, shape (6, 10, 5)."""
    terms = np.zeros((6, BASIS_SIZE, ALPHA0))
    terms[0, 0, 0] = 1.0
    for axis in range(3):
        terms[1, 1 + 2 * axis, 1 + axis] = terms[2, 2 + 2 * axis, 1 + axis] = 1.0
    terms[3, 7, 4] = terms[4, 8, 4] = terms[5, 9, 4] = 1.0
    return terms


TERMS: Final = _terms()
"""Of which `design` is the sum, each times one of `turns`."""


def turns(alpha0_deg: FloatArray | float) -> FloatArray:
    """1, cos, sin, cos², cos sin, sin² of one alpha0, shape (6,), or of several, shape (n, 6)."""
    alpha0_rad = np.deg2rad(alpha0_deg)
    cos, sin = np.cos(alpha0_rad), np.sin(alpha0_rad)
    return np.array([cos**0, cos, sin, cos**2, cos * sin, sin**2]).T


def turns_and_slopes(alpha0_deg: float) -> FloatArray:
    """`turns` of one alpha0, and their derivatives per radian, shape (2, 6)."""
    alpha0_rad = math.radians(alpha0_deg)
    cos, sin = math.cos(alpha0_rad), math.sin(alpha0_rad)
    return np.array(
        [
            [1.0, cos, sin, cos**2, cos * sin, sin**2],
            [0.0, -sin, cos, -2 * cos * sin, cos**2 - sin**2, 2 * cos * sin],
        ]
    )


def design(alpha0_deg: FloatArray | float, terms: int = 0) -> FloatArray:
    """How the coefficients of all columns follow from the linear parameters at given alpha0.

    Shape (..., 10 + terms, 5 + terms). The first ten columns are those of `basis`; each of `terms` further columns,
    linear additions to the declared model, has a coefficient of its own.
    """
    turned = np.tensordot(turns(alpha0_deg), TERMS, 1)
    if not terms:
        return np.asarray(turned)
    matrix = np.zeros((*turned.shape[:-2], BASIS_SIZE + terms, ALPHA0 + terms))
    matrix[..., :BASIS_SIZE, :ALPHA0] = turned
    matrix[..., BASIS_SIZE:, ALPHA0:] = np.eye(terms)
    return matrix


def design_slope(alpha0_deg: float) -> FloatArray:
    """Derivative of the first ten rows and five columns of `design` with respect to alpha0, per degree."""
    return np.deg2rad(np.tensordot(turns_and_slopes(alpha0_deg)[1], TERMS, 1))


def parameter_vector(linear: FloatArray, alpha0_deg: FloatArray | float) -> FloatArray:
    """Put alpha0 in its place among linear parameters of shape (..., 5 + terms)."""
    theta = np.empty((*linear.shape[:-1], linear.shape[-1] + 1))
    theta[..., :ALPHA0], theta[..., ALPHA0], theta[..., ALPHA0 + 1 :] = (
        linear[..., :ALPHA0],
        alpha0_deg,
        linear[..., ALPHA0:],
    )
    return theta


def coefficients(theta: FloatArray) -> FloatArray:
    """Coefficients of all columns, shape (..., 10 + terms), in volts, of parameter vectors of shape (..., 6 + terms).

    Parameters are in the units of `UNITS`, those of further columns in volts per unit of the column.
    """
    alpha0_rad = np.deg2rad(theta[..., ALPHA0])
    cos, sin, kxy = np.cos(alpha0_rad), np.sin(alpha0_rad), theta[..., 4]
    result = np.empty((*theta.shape[:-1], theta.shape[-1] - len(PARAMETERS) + BASIS_SIZE))
    result[..., 0] = theta[..., 0]
    result[..., _STRAIGHT] = cos[..., None] * theta[..., 1:4]
    result[..., _TURNED] = sin[..., None] * theta[..., 1:4]
    result[..., 7], result[..., 8], result[..., 9] = cos**2 * kxy, cos * sin * kxy, sin**2 * kxy
    result[..., BASIS_SIZE:] = theta[..., len(PARAMETERS) :]
    return result


def coefficients_jacobian(theta: FloatArray) -> FloatArray:
    """Derivative of `coefficients` with respect to one parameter vector, shape (10 + terms, 6 + terms)."""
    terms = len(theta) - len(PARAMETERS)
    straight = design(float(theta[ALPHA0]), terms)
    jacobian = np.zeros((BASIS_SIZE + terms, len(theta)))
    jacobian[:, :ALPHA0], jacobian[:, ALPHA0 + 1 :] = straight[:, :ALPHA0], straight[:, ALPHA0:]
    jacobian[:BASIS_SIZE, ALPHA0] = design_slope(float(theta[ALPHA0])) @ theta[:ALPHA0]
    return jacobian


def further_terms(compressed: Compressed) -> int:
    """Number of columns beyond the ten of the declared model."""
    return int(compressed.r.shape[1]) - BASIS_SIZE
