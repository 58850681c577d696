"""Least-squares solutions that say which unknowns the rows determine."""

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray

SINGULAR = 1e-8
"""Directions weaker than this, relative to the strongest, are taken as not observed: rounding, not physics."""


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


def smallest_solution(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Least-squares solution of one system, shape (p,); of those that fit equally well the smallest, columns scaled."""
    norm = np.linalg.norm(matrix, axis=0)
    scale = np.where(norm > SINGULAR * norm.max(), norm, np.inf)
    return np.asarray(np.linalg.lstsq(matrix / scale, right, rcond=SINGULAR)[0] / scale)


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
