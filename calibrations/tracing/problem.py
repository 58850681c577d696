"""One table with all its candidates, reduced to a square matrix in which any set of effects is fitted in no time."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from calibrations.compression import Compressed
from calibrations.conditional import SINGULAR
from calibrations.fit import JointFit, fit_given_alpha0, joint_fit, refined_fit
from calibrations.geometry import FloatArray
from calibrations.model import BASIS_SIZE, coefficients_jacobian
from calibrations.tracing.candidates import Candidate
from calibrations.tracing.noise import Whitening

_ABSORBED = 1e-5
"""A column of which less than this part is left beside the model is taken as absorbed by it."""


@dataclass(frozen=True, kw_only=True)
class Explanation:
    """A set of candidates, fitted jointly with the declared model."""

    chosen: tuple[int, ...]
    """Numbers of the candidates, in the order in which they were added."""
    fit: JointFit
    deviance: float
    """-2 ln L, up to a constant of the table."""


class Problem:
    """Declared model, candidates and noise of one table.

    Parameters
    ----------
    basis
        Functions of the declared model, shape (rows, 10).
    columns
        Columns of all candidates side by side, shape (rows, n).
    output_v
        Shape (rows,), in volts.
    weights
        Shape (rows,).
    offered
        The candidates.
    white
        What makes the noise white.
    alpha0_told
        Whether alpha0 is fitted; it is held at 0 otherwise.
    """

    def __init__(
        self,
        basis: FloatArray,
        columns: FloatArray,
        output_v: FloatArray,
        weights: FloatArray,
        offered: Sequence[Candidate],
        white: Whitening,
        alpha0_told: bool,
    ) -> None:
        root = np.sqrt(weights)[:, None]
        scale = np.linalg.norm(columns, axis=0)
        self._scale = np.where(scale > 0, scale, 1.0)
        everything = white(np.column_stack([basis, columns / self._scale, output_v]) * root)
        if everything.shape[0] > 2 * everything.shape[1]:
            everything = np.linalg.qr(everything, mode="r")  # type: ignore[assignment]
        self._r, self._z = everything[:, :-1], everything[:, -1]
        self._lengths = np.linalg.norm(self._r[:, BASIS_SIZE:], axis=0)
        self._rows = len(output_v)
        self._log_determinant = white.log_determinant
        self._alpha0_told = alpha0_told
        self.offered = tuple(offered)
        widths = np.array([candidate.columns.stop - candidate.columns.start for candidate in offered], dtype=int)
        self._starts = np.array([candidate.columns.start for candidate in offered], dtype=int)
        self._single, self._double, self._wide = (
            np.flatnonzero(test) for test in (widths == 1, widths == 2, widths > 2)
        )

    def explain(self, chosen: tuple[int, ...], near: FloatArray | None = None) -> Explanation:
        """Fit the declared model with the chosen candidates; `near` is a parameter vector of the declared part."""
        compressed = self._compressed(chosen)
        if not self._alpha0_told:
            fit = fit_given_alpha0(compressed, 0.0)
        elif near is None:
            fit = joint_fit(compressed)
        else:
            fit = refined_fit(compressed, np.concatenate([near, np.zeros(compressed.terms)]))
        return Explanation(chosen=chosen, fit=fit, deviance=self._deviance(fit.squares_v2))

    def gains(self, explanation: Explanation) -> FloatArray:
        """By how much each candidate would lower the deviance, linearised at the explanation; shape (candidates,)."""
        jacobian = coefficients_jacobian(explanation.fit.theta)[:BASIS_SIZE, :6]
        model = np.column_stack([self._r[:, :BASIS_SIZE] @ jacobian, self._r[:, self._columns(explanation.chosen)]])
        length = np.linalg.norm(model, axis=0)
        seen = length > SINGULAR * length.max()
        left, values, _ = np.linalg.svd(model[:, seen] / length[seen], full_matrices=False)
        span = left[:, values > _ABSORBED * values[0]]
        others = self._r[:, BASIS_SIZE:]
        free = others - span @ (span.T @ others)
        residual = self._z - span @ (span.T @ self._z)
        fall = self._falls(free, residual)
        fall[list(explanation.chosen)] = 0.0
        return np.asarray(
            -self._rows * np.log1p(-np.clip(fall / max(float(residual @ residual), 1e-300), 0.0, 1 - 1e-12))
        )

    def unscaled(self, explanation: Explanation) -> FloatArray:
        """Coefficients of the chosen candidates in their own units, one after the other."""
        scale = np.concatenate([np.empty(0), *(self._scale[self.offered[i].columns] for i in explanation.chosen)])
        return np.asarray(explanation.fit.theta[6:] / scale)

    def _falls(self, free: FloatArray, residual: FloatArray) -> FloatArray:
        """Fall of the sum of squares with each candidate, of whose columns `free` is left beside the model."""
        falls = np.zeros(len(self.offered))
        lengths = np.einsum("ij,ij->j", free, free)
        seen = lengths > (_ABSORBED * self._lengths) ** 2
        alone = np.where(seen, (residual @ free) ** 2 / np.where(seen, lengths, 1.0), 0.0)
        falls[self._single] = alone[self._starts[self._single]]
        falls[self._double] = self._falls_of_pairs(free, residual, alone)
        for number in self._wide:
            columns = self.offered[number].columns
            left, values, _ = np.linalg.svd(free[:, columns], full_matrices=False)
            along = left[:, values > _ABSORBED * self._lengths[columns].max()].T @ residual
            falls[number] = along @ along
        return falls

    def _falls_of_pairs(self, free: FloatArray, residual: FloatArray, alone: FloatArray) -> FloatArray:
        """The same for the candidates of two columns: what the first explains, then what the second adds."""
        first, second = self._starts[self._double], self._starts[self._double] + 1
        a, b = free[:, first], free[:, second]
        squares = np.maximum(np.einsum("ij,ij->j", a, a), 1e-300)
        beside = b - a * (np.einsum("ij,ij->j", a, b) / squares)
        lengths = np.einsum("ij,ij->j", beside, beside)
        seen = lengths > (_ABSORBED * self._lengths[second]) ** 2
        return np.asarray(alone[first] + np.where(seen, (residual @ beside) ** 2 / np.where(seen, lengths, 1.0), 0.0))

    def _compressed(self, chosen: tuple[int, ...]) -> Compressed:
        """The rows as only the declared model and the chosen candidates see them."""
        picked = np.column_stack([self._r[:, :BASIS_SIZE], self._r[:, self._columns(chosen)], self._z])
        triangular: FloatArray = np.linalg.qr(picked, mode="r")  # type: ignore[assignment]
        size = min(triangular.shape[0], triangular.shape[1] - 1)
        rest = float(triangular[-1, -1] ** 2) if triangular.shape[0] > size else 0.0
        padded = np.zeros((triangular.shape[1] - 1, triangular.shape[1]))
        padded[:size] = triangular[:size]
        return Compressed(r=padded[:, :-1], z=padded[:, -1], rotation=np.empty((0, 0)), rest_v2=rest)

    def _columns(self, chosen: tuple[int, ...]) -> list[int]:
        return [
            BASIS_SIZE + column
            for number in chosen
            for column in range(self.offered[number].columns.start, self.offered[number].columns.stop)
        ]

    def _deviance(self, squares_v2: float) -> float:
        return self._rows * float(np.log(max(squares_v2, 1e-300) / self._rows)) + self._log_determinant
