"""How much a component would explain beside everything that a table is traced to already.

Whitened rows beside the columns of the model are split once. With F the columns of a component there, one eigen-
decomposition of F'F gives the likelihood for every ratio of its variance to that of a dwell.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from hashlib import blake2b
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.effect import Form
from tumble.calibrations.tracing.linearised import directions, orthogonal_to
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.table import Table

_RATIOS: Final = 10.0 ** np.arange(-3.5, 4.6, 0.4)
"""Of the variance of a row by the component to that of a dwell."""

_SEEN: Final = 1e-6
"""What is left of a column beside the others, in parts of the longest, is seen if it is more than this."""
_REST: Final = 0.3
"""Part of what a component explains that must not lie in two rows."""
Gained = tuple[float, float]
"""Fall of -2 ln L, and mean variance of a row in units of that of a dwell."""


@dataclass(frozen=True, kw_only=True)
class Beside:
    """Weighted, whitened rows beside all columns of the model, as sums over rows may be made of them."""

    root: FloatArray
    """Roots of the weights, shape (rows,)."""
    taken: FloatArray
    """Directions T that noise or model take, shape (rows, n): of weighted columns F, F'F - (F'T)(F'T)' is left."""
    left: FloatArray
    """What is left of the output, made white twice, shape (rows,)."""
    squares: float
    """Sum of squares of what is left."""

    @cached_property
    def fingerprint(self) -> bytes:
        """The same for the same rows beside the same."""
        digest = blake2b()
        for each in (self.root, self.taken, self.left):
            digest.update(np.ascontiguousarray(each).tobytes())
        return digest.digest()

    def rests_on_several_rows(self, columns: FloatArray) -> bool:
        """Whether columns, fitted, would still show most of what they do without the two rows that show most of it.

        What does not would take gross errors for structure.
        """
        weighted = columns * self.root[:, None]
        sums = self.taken.T @ weighted
        gram, with_output = weighted.T @ weighted - sums.T @ sums, weighted.T @ self.left
        sizes = np.linalg.lstsq(gram, with_output, rcond=_SEEN)[0]
        squares = np.sort((weighted @ sizes - self.taken @ (sums @ sizes)) ** 2)
        return bool(squares[:-2].sum() > _REST * squares.sum())


def seen_beside(table: Table, forms: Sequence[Form], noise: NoiseModel) -> Beside:
    """The rows beside the declared model, linearised at its fit, and the forms in a noise."""
    root, white = np.sqrt(table.weights), table.memory.whitening(noise)
    theta = table.fit(forms, noise).theta
    slopes = table.model.slopes(theta[: table.model.parameters])
    columns = np.column_stack([table.declared @ slopes, *(form.columns for form in forms)])
    span = directions(white(columns * root[:, None]))
    everything = np.column_stack([table.declared, *(form.columns for form in forms)])
    misfit = white((table.output - everything @ table.model.coefficients(theta)) * root)
    rest = orthogonal_to(span, misfit)
    return Beside(
        root=root,
        taken=np.column_stack([white.taken, white(span)]),
        left=white(rest),
        squares=float(rest @ rest),
    )


def gains(values: FloatArray, power: FloatArray, squares: float, rows: int) -> tuple[FloatArray, FloatArray]:
    """Fall of -2 ln L of components with n columns each, and the ratio of variances at which it is so large.

    `values` are the eigenvalues of F'F for columns with a mean square of one in a row, shape (components, n), `power`
    the squares of the output along its eigenvectors, `squares` what is left of the output without them.
    """
    loaded = 1.0 + _RATIOS[:, None] * np.clip(values, 0.0, None)[:, None, :]
    fall = np.sum(_RATIOS[:, None] * power[:, None, :] / loaded, axis=-1)
    return _best_ratios(fall, np.sum(np.log(loaded), axis=-1), squares, rows)


def _best_ratios(
    fall: FloatArray, log_determinant: FloatArray, squares: float, rows: int
) -> tuple[FloatArray, FloatArray]:
    """Gain and ratio of variances where it is largest, by the fall of the sum of squares at each of `_RATIOS`."""
    part = np.clip(fall / squares, 0.0, 1.0 - 1e-12)
    gains = -rows * np.log1p(-part) - log_determinant
    best = np.argmax(gains, axis=1)
    return gains[np.arange(len(gains)), best], _RATIOS[best]


def gain_of_process(gram: FloatArray, with_output: FloatArray, squares: float, rows: int) -> Gained:
    """The same of one component with many columns F of a mean square of one in a row, from F'F and F'y.

    In directions of which the first is that of F'y, F'F is tridiagonal (Householder); so is what every ratio adds to,
    and its factors, from the last direction on, give both the determinant and what is left of the first direction. That
    is an eighth of the work of the eigenvalues.
    """
    from scipy.linalg.lapack import dpttrf, dsytrd

    size = len(gram)
    bordered = np.zeros((size + 2, size + 2))  # with one direction in which there is nothing: LAPACK asks for two
    bordered[1:-1, 0], bordered[1:-1, 1:-1] = with_output, gram
    _, diagonal, beside, _, _ = dsytrd(bordered, lower=1)
    loaded = 1.0 + _RATIOS[:, None] * diagonal[:0:-1]
    factors = np.array([dpttrf(row, ratio * beside[:0:-1])[0] for ratio, row in zip(_RATIOS, loaded, strict=True)])
    fall, log_determinant = _RATIOS * beside[0] ** 2 / factors[:, -1], np.sum(np.log(factors), axis=1)
    (gain,), (variance,) = _best_ratios(fall[None], log_determinant[None], squares, rows)
    return float(gain), float(variance)


def gains_of_pairs(
    squares: float, rows: int, sums: tuple[FloatArray, FloatArray], products: tuple[FloatArray, FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Gains and variances of shapes of two columns, of which there are as many as columns of each array.

    `sums` are the products of the columns with what is taken, then with what is left of the output; `products` those of
    the first with themselves, of the second with themselves, and of the first with the second.
    """
    (first, second), (ones, twos, mixed) = sums, products
    gram = np.empty((len(ones), 2, 2))
    gram[:, 0, 0] = ones - np.sum(first[:-1] ** 2, axis=0)
    gram[:, 1, 1] = twos - np.sum(second[:-1] ** 2, axis=0)
    gram[:, 0, 1] = gram[:, 1, 0] = mixed - np.sum(first[:-1] * second[:-1], axis=0)
    values, vectors = np.linalg.eigh(gram)
    whole = ones + twos
    scale = (np.where(whole > 0.0, whole, 1.0) / rows)[:, None]
    power = np.einsum("wji,jw->wi", vectors, np.stack([first[-1], second[-1]])) ** 2
    return gains(values / scale, power / scale, squares, rows)


def best_column(
    left: FloatArray, whole: FloatArray, power: FloatArray, squares: float, rows: int
) -> tuple[int, Gained]:
    """Which of single columns gains most: `left` of its square `whole` is seen beside the model.

    With t the part of the squares that a column explains, the likelihood is best where a part x of its power is noise:
    n ln(1 - t + t x) - ln x is least at x = (1 - t) / ((n - 1) t).
    """
    told = left > _SEEN * whole.max()
    seen = np.where(told, left, 1.0)
    part = np.clip(np.where(told, power, 0.0) / (seen * squares), 1e-12, 1.0 - 1e-12)
    noise = np.minimum((1.0 - part) / ((rows - 1) * part), 1.0)
    fall = -rows * np.log1p(part * (noise - 1.0)) + np.log(noise)
    best = int(np.argmax(fall))
    variance = (1.0 / noise[best] - 1.0) * whole[best] / (rows * seen[best])
    return best, (float(fall[best]), float(variance))
