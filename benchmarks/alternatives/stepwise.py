"""Forward stepwise selection by the Bayesian information criterion (Schwarz 1978)."""

import numpy as np
from numpy.typing import NDArray

from benchmarks.alternatives.columns import Block, Regression
from tumble.calibrations.core.arrays import FloatArray


def stepwise(regression: Regression) -> NDArray[np.bool_]:
    """Which columns are those of the forms that are added, one after the other, as long as one lowers BIC.

    A form enters with all its columns; what was scanned for counts as a coefficient too.
    """
    free, residual = regression.columns, regression.target
    left, chosen = list(regression.blocks), np.zeros(len(regression.owners), dtype=bool)
    while left:
        changes = [_change_of_bic(free, residual, block) for block in left]
        best = int(np.argmin(changes))
        if changes[best] >= 0.0:
            break
        block = left.pop(best)
        chosen[block.members] = True
        span = _span(free, block)
        free, residual = free - span @ (span.T @ free), residual - span @ (span.T @ residual)
    return chosen


def _change_of_bic(free: FloatArray, residual: FloatArray, block: Block) -> float:
    along = _span(free, block).T @ residual
    rows, left_over = len(residual), 1.0 - float(along @ along) / float(residual @ residual)
    return rows * float(np.log(max(left_over, 1e-300))) + block.coefficients * float(np.log(rows))


def _span(free: FloatArray, block: Block) -> FloatArray:
    """Orthonormal directions that the form adds to what is chosen already."""
    left, values, _ = np.linalg.svd(free[:, block.members], full_matrices=False)
    return np.asarray(left[:, values > 1e-5])
