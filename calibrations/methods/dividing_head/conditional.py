"""Least squares for given alpha0: everything else in the declared model is then linear."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.dividing_head.model import design, further_terms


@dataclass(frozen=True, kw_only=True)
class Conditional:
    """Best linear parameters at each of n values of alpha0."""

    alpha0_deg: FloatArray
    """Shape (n,)."""
    linear: FloatArray
    """u0, kx, ky, kz, kxy and the further coefficients, shape (n, 5 + terms).

    Of those that the rows cannot tell apart, the smallest.
    """
    cofactor: FloatArray
    """Covariance of `linear` per unit variance of a row, shape (n, 5 + terms, 5 + terms)."""
    estimable: NDArray[np.bool_]
    """Whether the rows determine each linear parameter, shape (n, 5 + terms)."""
    squares_v2: FloatArray
    """Weighted sum of squared residuals, shape (n,), in square volts."""


def conditional(compressed: Compressed, alpha0_deg: FloatArray) -> Conditional:
    """Solve the linear part of the declared model at each of `alpha0_deg`, shape (n,)."""
    matrix = compressed.r @ design(alpha0_deg, further_terms(compressed))
    inverse, estimable = pseudo_inverse(matrix)
    linear = inverse @ compressed.z
    misfit = compressed.z - np.einsum("nij,nj->ni", matrix, linear)
    return Conditional(
        alpha0_deg=alpha0_deg,
        linear=linear,
        cofactor=inverse @ np.swapaxes(inverse, -1, -2),
        estimable=estimable,
        squares_v2=compressed.rest_v2 + np.sum(misfit**2, axis=-1),
    )
