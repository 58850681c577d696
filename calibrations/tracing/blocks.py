"""Blocks of rows that share a value of a variable: what they differ by, and how well each is told by the others."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.linearised import RESOLVED, PartialRegression, orthogonal_to

WITHIN: Final = 0.1
"""What varies by less than this part within blocks is a function of the block."""
_AGREE_P: Final = 0.05
"""Above this blocks agree on the size of an effect by their repeats."""
_RIDGE: Final = 1e-9
IntArray = NDArray[np.int64]


def within(values: FloatArray, block: IntArray) -> float:
    """Part of the variance of values that lies within blocks."""
    mean = np.asarray(np.bincount(block, values) / np.bincount(block), dtype=float)
    inside = float(np.mean((values - mean[block]) ** 2))
    return inside / max(float(np.var(values)), 1e-300)


@dataclass(frozen=True, kw_only=True)
class Lack:
    """What blocks differ by without a shape, and an effect against it."""

    blocks: int
    freedom: int
    mean_square: float
    """Of the lack of fit, or of the pure error where that is larger."""
    p_value: float
    """Chance of the effect without that it is there."""
    between: float
    """Mean square of the lack of fit."""
    pure: float
    """Mean square of the scatter within blocks; 0 where there are no repeats."""
    alike: float
    """Chance of so much lack of fit by the scatter within blocks; 1 where nothing can be tested."""


def lack_of_fit(partial: PartialRegression, block: IntArray) -> Lack:
    """The effect against what blocks differ by beyond it, with a number for each: a level, or a size of its own."""
    everything = np.column_stack([partial.others, partial.own])
    rest = float(np.sum(orthogonal_to(everything, partial.left) ** 2))
    explained = float(np.sum((partial.own.T @ partial.left) ** 2))
    constant = not partial.own.size or within(partial.stated, block) < WITHIN
    level = partial.root if constant else partial.signal
    power = np.asarray(np.bincount(block, level**2), dtype=float)
    resolved = power > RESOLVED**2 * power.max(initial=0.0)
    inside = _off_blocks(np.column_stack([everything, partial.left]), level, block, np.where(resolved, power, np.inf))
    left, values, _ = np.linalg.svd(inside[:, :-1], full_matrices=False)
    scatter = float(np.sum(orthogonal_to(left[:, values > RESOLVED], inside[:, -1]) ** 2))
    rank = int(np.count_nonzero(resolved)) + int(np.count_nonzero(values > RESOLVED))
    return _judged(
        blocks=len(np.unique(block)),
        inside_too=not constant,
        explained=(explained, partial.own.shape[1]),
        between=(max(rest - scatter, 0.0), rank - everything.shape[1]),
        inside=(scatter, len(partial.left) - rank),
    )


_Squares = tuple[float, int]
"""A sum of squares with its degrees of freedom."""


def _judged(blocks: int, inside_too: bool, explained: _Squares, between: _Squares, inside: _Squares) -> Lack:
    """Analysis of variance: the effect against the larger of lack of fit and pure error, with the former's freedom.

    An effect that is seen inside each block is measured by the repeats there; if three blocks or more agree on its
    size, both are one ruler.
    """
    freedom, width = max(between[1], 0), explained[1]
    lack, pure = _mean_square(between), _mean_square(inside)
    mean_square, ruler = max(lack, pure, 1e-300), freedom
    alike = float(fdtrc(freedom, inside[1], lack / pure)) if freedom > 0 and pure > 0 else 1.0
    if inside_too and freedom > 1 and inside[1] > 0 and alike > _AGREE_P:
        ruler = freedom + inside[1]
        mean_square = max((between[0] + inside[0]) / ruler, 1e-300)
    testable = freedom > 0 and width > 0
    return Lack(
        blocks=blocks,
        freedom=freedom,
        mean_square=mean_square,
        p_value=float(fdtrc(width, ruler, explained[0] / width / mean_square)) if testable else 1.0,
        between=lack,
        pure=pure,
        alike=alike,
    )


def _mean_square(squares: _Squares) -> float:
    return squares[0] / squares[1] if squares[1] > 0 else 0.0


def _off_blocks(columns: FloatArray, level: FloatArray, block: IntArray, power: FloatArray) -> FloatArray:
    """Columns without what a number for each block, times `level`, can follow."""
    sums = np.zeros((len(power), columns.shape[1]))
    np.add.at(sums, block, level[:, None] * columns)
    return np.asarray(columns - level[:, None] * (sums / power[:, None])[block])


def held_out_gain(partial: PartialRegression, block: IntArray) -> float:
    """By how much the sum of squares of errors of blocks that are held out falls with the effect."""
    with_it = np.column_stack([partial.others, partial.own])
    return press(partial.others, partial.left, block) - press(with_it, partial.left, block)


def press(directions_: FloatArray, output: FloatArray, block: IntArray) -> float:
    """Sum of squares of errors of blocks, each predicted from all the others (Allen 1974), without a refit.

    With G the part of Q'Q that a block has, the coefficients from the others are (1 - G)⁻¹ of what they show; for a
    block of one row the error is the residual over one minus its leverage. What only the block shows is predicted as
    nothing.
    """
    shown = directions_.T @ output
    order = np.argsort(block, kind="stable")
    starts = np.flatnonzero(np.diff(block[order], prepend=-1))
    lengths = np.diff(starts, append=len(order))
    if len(starts) == len(output):
        alone = 1.0 - np.sum(directions_**2, axis=1)
        resolved = alone > _RIDGE
        left = output - directions_ @ shown
        return float(np.sum(np.where(resolved, left / np.where(resolved, alone, 1.0), output) ** 2))
    alike = (starts[lengths == length, None] + np.arange(length) for length in np.unique(lengths))
    return sum(_blocks_error(directions_[order[rows]], output[order[rows]], shown) for rows in alike)


def _blocks_error(q: FloatArray, y: FloatArray, shown: FloatArray) -> float:
    """Sum of squares of the errors of n blocks of m rows: `q` has shape (n, m, directions), `y` shape (n, m).

    `shown` is what all rows show along the directions. Whichever is smaller is solved for: as
    Q (1 - Q'Q)⁻¹ = (1 - QQ')⁻¹ Q, the directions or the rows of a block.
    """
    turned = np.swapaxes(q, -1, -2)
    others = shown[:, None] - turned @ y[..., None]
    if y.shape[1] < len(shown):
        predicted = np.linalg.solve(_rest(q @ turned), q @ others)
    else:
        predicted = q @ np.linalg.solve(_rest(turned @ q), others)
    return float(np.sum((y - predicted[..., 0]) ** 2))


def _rest(parts: FloatArray) -> FloatArray:
    """What is left of one beside parts of it, matrices of shape (..., k, k); never quite nothing."""
    return np.asarray((1.0 + _RIDGE) * np.eye(parts.shape[-1]) - parts)
