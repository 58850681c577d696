"""Least-squares solutions that say which unknowns the rows determine."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import triangular_factor

SINGULAR = 1e-8
"""Directions weaker than this, relative to the strongest, are taken as not observed: rounding, not physics."""


_SURELY_INDEPENDENT = 1e8
"""Columns whose normal equations have a smaller condition have none that is near the others."""
_CERTAIN = 1e-5
"""Columns whose reciprocal condition is estimated larger than this have no direction that is singular."""


def pseudo_inverse(matrix: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Pseudo-inverse of matrices of shape (..., m, p), and which of the p unknowns each determines, shape (..., p).

    Columns are scaled first, so that a parameter with a small unit does not look unobserved.
    """
    norm = np.linalg.norm(matrix, axis=-2)
    seen = norm > SINGULAR * norm.max(axis=-1, keepdims=True)
    scale = np.where(seen, norm, np.inf)
    u, s, vt = np.linalg.svd(matrix / scale[..., None, :], full_matrices=False)
    kept = s > SINGULAR * s[..., :1]
    inverse_s = np.where(kept, 1.0 / np.where(kept, s, 1.0), 0.0)
    inverse = np.swapaxes(vt, -1, -2) @ (inverse_s[..., None] * np.swapaxes(u, -1, -2))
    resolved = np.sum(np.where(kept[..., None], vt, 0.0) ** 2, axis=-2)
    return inverse / scale[..., :, None], seen & (resolved > 1 - 1e-6)


def quick_pseudo_inverse(matrix: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The same but for rounding, several times faster where columns are certainly independent."""
    norm = np.linalg.norm(matrix, axis=-2)
    scale = np.where(norm > SINGULAR * norm.max(axis=-1, keepdims=True), norm, np.inf)
    if (inverse := _certain_inverse(matrix / scale[..., None, :])) is None:
        return pseudo_inverse(matrix)
    return inverse / scale[..., :, None], np.isfinite(scale)


def _certain_inverse(matrix: FloatArray) -> FloatArray | None:
    """Inverse by the normal equations, several times faster, of columns certainly independent; None for others.

    One step of Newton's iteration (Ben-Israel 1965) takes away what the normal equations lose.
    """
    turned = np.swapaxes(matrix, -1, -2)
    normal = turned @ matrix
    try:
        inverse = np.linalg.inv(normal)
    except np.linalg.LinAlgError:
        return None
    condition = np.linalg.norm(normal, axis=(-2, -1)) * np.linalg.norm(inverse, axis=(-2, -1))
    if not np.all(condition < _SURELY_INDEPENDENT):
        return None
    first = inverse @ turned
    return np.asarray(2.0 * first - (first @ matrix) @ first)


def least_solution(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Least-squares solution of one system, shape (p,); of those that fit equally well the smallest.

    By QR, an eighth of the work, unless columns are near being dependent.
    """
    from scipy.linalg.lapack import dgels, dtrcon

    rows, unknowns = matrix.shape
    if rows >= unknowns:
        factored, solved, _ = dgels(matrix, right)
        if dtrcon(factored[:unknowns])[0] > _CERTAIN:
            return np.asarray(solved[:unknowns])
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=SINGULAR)[0])


def smallest_solution(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Least-squares solution of one system, shape (p,); of those that fit equally well the smallest, columns scaled."""
    norm = np.linalg.norm(matrix, axis=0)
    scale = np.where(norm > SINGULAR * norm.max(), norm, np.inf)
    return least_solution(matrix / scale, right) / scale


def triangular_solution(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """The same where the matrix is upper triangular: put in from below unless that is near a singular one."""
    from scipy.linalg.lapack import dtrcon, dtrtrs

    rows, unknowns = matrix.shape
    scale = np.linalg.norm(matrix, axis=0)
    if rows == unknowns and scale.all():
        scaled = matrix / scale
        if dtrcon(scaled)[0] > _CERTAIN:
            return np.asarray(dtrtrs(scaled, right)[0] / scale)
    return smallest_solution(matrix, right)


def left_beside(matrix: FloatArray, columns: FloatArray) -> FloatArray:
    """Columns as only what is orthogonal to those of a matrix sees them, both of as many rows, turned."""
    from scipy.linalg.lapack import dtrcon

    taken = matrix.shape[1]
    triangular = triangular_factor(np.hstack([matrix, columns]))
    if dtrcon(triangular[:taken, :taken])[0] > _CERTAIN:
        return triangular[taken:, taken:]
    left, values, _ = np.linalg.svd(matrix)
    return np.asarray(left[:, np.count_nonzero(values > SINGULAR * values[0]) :].T @ columns)
