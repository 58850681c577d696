"""The best two forms at once: what one of them explains may show only beside the other.

A step and a wave of one voltage, each alone at its best place, are at the wrong one. With U an orthonormal basis of the
columns of each form beside what is followed already, C = U_i' U_j, and r = U' y, two forms together explain

    r_i' r_i + (r_j - C' r_i)' (1 - C' C)⁻¹ (r_j - C' r_i)

of the sum of squares of y: a regression on the one, then on what the other adds (Draper and Smith, 2.6).
"""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.problem import Beside, Explanation, Problem

_SEEN: Final = 1e-10
"""Part of the square of a column that must be left beside what is followed already."""
_ADDED: Final = 1e-4
"""Part of the square of a form that must be left beside another."""
WIDEST: Final = 2
"""Columns of a form."""


def best_pair(problem: Problem, explanation: Explanation, numbers: Sequence[int]) -> tuple[int, ...]:
    """Numbers of the two candidates, of two effects, that are worth most together; none where there are no two effects.

    Of the candidates of the given numbers, of one or two columns each.
    """
    return next((pair for pair, _ in best_pairs(problem, explanation, numbers)), ())


def best_pairs(
    problem: Problem, explanation: Explanation, numbers: Sequence[int]
) -> Iterator[tuple[tuple[int, int], float]]:
    """The best two candidates of each two effects, and what they are worth together; the best ones first."""
    tried = [number for number in numbers if problem.penalties[number] < np.inf]
    name = np.array([problem.offered[number].effect.name for number in tried])
    if len(set(name.tolist())) < 2:
        return
    worth = np.where(name[:, None] == name, -np.inf, _worth(problem, explanation, tried))
    listed = set[frozenset[str]]()
    for place in np.argsort(-worth, axis=None, kind="stable"):
        first, second = divmod(int(place), len(tried))
        if worth[first, second] == -np.inf:
            return
        if (effects := frozenset((str(name[first]), str(name[second])))) not in listed:
            listed.add(effects)
            yield (tried[first], tried[second]), float(worth[first, second])


def _worth(problem: Problem, explanation: Explanation, tried: Sequence[int]) -> FloatArray:
    """Fall of the deviance less both penalties, for every two of the candidates."""
    beside = problem.beside(explanation, problem.columns_of(tuple(tried)))
    widths = [len(problem.columns_of((number,))) for number in tried]
    falls = _falls(beside, widths)
    part = np.clip(falls / max(beside.squares, 1e-300), 0.0, 1.0 - 1e-12)
    penalties = problem.penalties[list(tried)]
    return np.asarray(-beside.rows * np.log1p(-part) - penalties[:, None] - penalties)


def _falls(beside: Beside, widths: Sequence[int]) -> FloatArray:
    """Fall of the sum of squares with every two forms, shape (forms, forms)."""
    basis = _orthonormal(beside, widths)
    crossed = basis.T @ beside.gram @ basis
    seen = basis.T @ beside.with_output
    count = len(widths)
    cross = crossed.reshape(count, WIDEST, count, WIDEST).transpose(0, 2, 1, 3)
    residual = seen.reshape(count, WIDEST)
    rest = residual[None, :, :] - np.einsum("ijab,ia->ijb", cross, residual)
    inner = np.eye(WIDEST) - np.einsum("ijab,ijac->ijbc", cross, cross)
    (a, b), (_, d) = (inner[..., 0, 0], inner[..., 0, 1]), (inner[..., 1, 0], inner[..., 1, 1])
    determinant = a * d - b**2
    told = determinant > _ADDED
    added = d * rest[..., 0] ** 2 - 2.0 * b * rest[..., 0] * rest[..., 1] + a * rest[..., 1] ** 2
    alone = np.sum(residual**2, axis=1)[:, None]
    return np.asarray(alone + np.where(told, added / np.where(told, determinant, 1.0), 0.0))


def _orthonormal(beside: Beside, widths: Sequence[int]) -> FloatArray:
    """Combinations of the columns that are an orthonormal basis of each form, two for each, zero where it has fewer."""
    basis = np.zeros((len(beside.gram), WIDEST * len(widths)))
    start = 0
    for place, width in enumerate(widths):
        columns = slice(start, start + width)
        values, vectors = np.linalg.eigh(beside.gram[columns, columns])
        kept = values > _SEEN
        basis[columns, WIDEST * place : WIDEST * place + np.count_nonzero(kept)] = vectors[:, kept] / np.sqrt(
            values[kept]
        )
        start += width
    return basis
