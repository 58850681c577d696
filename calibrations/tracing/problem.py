"""One table with all its candidates, split once so that any set of effects is fitted and judged in no time."""

from collections.abc import Collection, Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.solutions import SINGULAR
from tumble.calibrations.tracing.candidates import Candidate
from tumble.calibrations.tracing.effect import Structure
from tumble.calibrations.tracing.whitened import Fitted, WhitenedFit

_ABSORBED = 1e-5
"""A column of which less than this part is left orthogonal to the model is taken as absorbed by it."""


@dataclass(frozen=True, kw_only=True)
class Explanation:
    """A set of candidates, fitted jointly with the declared model."""

    chosen: tuple[int, ...]
    """Numbers of the candidates, in the order in which they were added."""
    fit: Fitted
    deviance: float
    """-2 ln L, up to a constant of the table."""


@dataclass(frozen=True, kw_only=True)
class Beside:
    """Columns beside an explanation: what of them is orthogonal to all that it follows."""

    gram: FloatArray
    """Their products with each other, shape (n, n)."""
    with_output: FloatArray
    """Their products with what is left of the output, shape (n,)."""
    squares: float
    """Sum of squares of that."""
    rows: int


class Problem:
    """Declared model, candidates and noise of one table.

    Parameters
    ----------
    whitened_fit
        The declared model in the noise.
    columns
        Columns of all candidates side by side, weighted and turned, shape (turned rows, n).
    offered
        The candidates.
    most
        How many of them are looked for at most.
    """

    def __init__(self, whitened_fit: WhitenedFit, columns: FloatArray, offered: Sequence[Candidate], most: int) -> None:
        self.most = most
        length = np.linalg.norm(columns, axis=0)
        self._scale = np.where(length > 0, length, 1.0)
        self._whitened_fit = whitened_fit
        self._split = whitened_fit.split(columns / self._scale).by_columns()
        projected, orthogonal = self._split.projected, self._split.orthogonal
        output = whitened_fit.output
        self._squares = np.sum(projected**2, axis=0) + np.einsum("ij,ij->j", orthogonal, orthogonal)
        self._with_output = projected.T @ output.projected[:, 0] + orthogonal.T @ output.orthogonal[:, 0]
        self._rows = whitened_fit.rows
        self._explained: dict[tuple[int, ...], Explanation] = {}
        self._promised: dict[tuple[int, ...], FloatArray] = {}
        self.offered = tuple(offered)
        self.penalties = np.array([candidate.penalty for candidate in offered])
        self.repeat_penalties = np.array([candidate.repeat_penalty for candidate in offered])
        self.forms = _places(offered)
        """Where the forms of each effect stand among the candidates."""
        self._by_effect, self._is_form = _side_by_side(tuple(self.forms.values()))
        widths = np.array([candidate.columns.stop - candidate.columns.start for candidate in offered], dtype=int)
        starts = np.array([candidate.columns.start for candidate in offered], dtype=int)
        self._single, self._double, self._wide = (
            np.flatnonzero(test) for test in (widths == 1, widths == 2, widths > 2)
        )
        self._alone, self._first = starts[self._single], starts[self._double]
        second = self._first + 1
        self._between = np.sum(projected[:, self._first] * projected[:, second], axis=0) + np.einsum(
            "ij,ij->j", orthogonal[:, self._first], orthogonal[:, second]
        )

    def named(self) -> "Problem":
        """The same with nothing on offer but effects of the catalogue."""
        other = copy(self)
        unnamed = [isinstance(candidate.effect, Structure) for candidate in self.offered]
        other.penalties = np.where(unnamed, np.inf, self.penalties)
        return other

    def without(self, names: Collection[str]) -> "Problem":
        """The same with some effects not on offer."""
        other = copy(self)
        barred = [candidate.effect.name in names for candidate in self.offered]
        other.penalties = np.where(barred, np.inf, self.penalties)
        return other

    def explain(self, chosen: tuple[int, ...]) -> Explanation:
        """Fit the declared model with the chosen candidates."""
        if chosen not in self._explained:
            self._explained[chosen] = self._fitted(chosen)
        return self._explained[chosen]

    def _fitted(self, chosen: tuple[int, ...]) -> Explanation:
        fit = self._whitened_fit.fit(self._split.pick(self.columns_of(chosen)))
        return Explanation(chosen=chosen, fit=fit, deviance=self._whitened_fit.deviance(fit))

    def best_forms(self, worth: FloatArray) -> list[int]:
        """Number of the candidate of each effect that is worth most, by the worth of all candidates."""
        forms = np.where(self._is_form, worth[self._by_effect], -np.inf)
        return [int(number) for number in self._by_effect[:, 0] + forms.argmax(axis=1)] if len(worth) else []

    def parameters(self, explanation: Explanation) -> FloatArray:
        """Declared parameters and the coefficients of the chosen candidates, in their own units."""
        theta = explanation.fit.theta.copy()
        theta[explanation.fit.parameters :] /= self._scale[self.columns_of(explanation.chosen)]
        return theta

    def columns_of(self, chosen: tuple[int, ...]) -> list[int]:
        """Where the columns of candidates stand among all columns."""
        return [
            column
            for number in chosen
            for column in range(self.offered[number].columns.start, self.offered[number].columns.stop)
        ]

    def gains(self, explanation: Explanation) -> FloatArray:
        """By how much each candidate would lower the deviance, linearised at the explanation; shape (candidates,)."""
        if explanation.chosen not in self._promised:
            self._promised[explanation.chosen] = self._gains(explanation)
        return self._promised[explanation.chosen]

    def _gains(self, explanation: Explanation) -> FloatArray:
        span, residual = self._linearised(explanation)
        falls = self._falls(span, self._with_output - span.T @ residual[0])
        falls[list(explanation.chosen)] = 0.0
        part = np.clip(falls / max(residual[1], 1e-300), 0.0, 1 - 1e-12)
        return np.asarray(-self._rows * np.log1p(-part))

    def beside(self, explanation: Explanation, columns: Sequence[int]) -> Beside:
        """Some of all columns as they are orthogonally to an explanation, linearised at it."""
        span, residual = self._linearised(explanation)
        projected, orthogonal = self._split.projected[:, columns], self._split.orthogonal[:, columns]
        gram = projected.T @ projected + orthogonal.T @ orthogonal - span[:, columns].T @ span[:, columns]
        left = (self._with_output - span.T @ residual[0])[columns]
        return Beside(gram=gram, with_output=left, squares=residual[1], rows=self._rows)

    def _linearised(self, explanation: Explanation) -> tuple[FloatArray, tuple[FloatArray, float]]:
        """All columns projected on the directions that the explanation can follow, shape (directions, n).

        With it the output projected these directions, and the sum of squares that is left of the output.
        """
        picked = self._split.pick(self.columns_of(explanation.chosen))
        q, _ = np.linalg.qr(picked.orthogonal)
        slopes = self._whitened_fit.declared.slopes(explanation.fit.theta)
        size, parameters = slopes.shape
        jacobian = np.zeros((size + q.shape[1], parameters + picked.projected.shape[1]))
        jacobian[:size, :parameters] = self._whitened_fit.r @ slopes
        jacobian[:size, parameters:] = picked.projected
        jacobian[size:, parameters:] = q.T @ picked.orthogonal
        directions = _directions(jacobian)
        output = self._whitened_fit.output
        seen = np.concatenate([output.projected[:, 0], q.T @ output.orthogonal[:, 0]])
        rest = output.orthogonal[:, 0] - q @ seen[size:]
        left = seen - directions @ (directions.T @ seen)
        columns = directions[:size].T @ self._split.projected + (q @ directions[size:]).T @ self._split.orthogonal
        return columns, (directions.T @ seen, float(rest @ rest + left @ left))

    def _falls(self, span: FloatArray, residual: FloatArray) -> FloatArray:
        """Fall of the sum of squares with each candidate.

        `span` are the columns projected on what is followed already, `residual` those on what is left of the output.
        """
        falls = np.zeros(len(self.offered))
        lengths = self._squares - np.sum(span**2, axis=0)
        seen = lengths > _ABSORBED**2 * self._squares
        alone = np.where(seen, residual**2 / np.where(seen, lengths, 1.0), 0.0)
        falls[self._single] = alone[self._alone]
        falls[self._double] = self._falls_of_pairs(span, residual, lengths, alone)
        for number in self._wide:
            columns = self.offered[number].columns
            projected, orthogonal = self._split.projected[:, columns], self._split.orthogonal[:, columns]
            gram = projected.T @ projected + orthogonal.T @ orthogonal - span[:, columns].T @ span[:, columns]
            values, vectors = np.linalg.eigh(gram)
            kept = values > _ABSORBED**2 * self._squares[columns].max()
            falls[number] = np.sum((vectors[:, kept].T @ residual[columns]) ** 2 / values[kept])
        return falls

    def _falls_of_pairs(
        self, span: FloatArray, residual: FloatArray, lengths: FloatArray, alone: FloatArray
    ) -> FloatArray:
        """The same for the candidates of two columns: what the first explains, then what the second adds."""
        first, second = self._first, self._first + 1
        between = self._between - np.sum(span[:, first] * span[:, second], axis=0)
        part = between / np.maximum(lengths[first], _ABSORBED**2 * self._squares[first] + 1e-300)
        orthogonal = lengths[second] - part * between
        seen = orthogonal > _ABSORBED**2 * self._squares[second]
        added = (residual[second] - part * residual[first]) ** 2
        return np.asarray(alone[first] + np.where(seen, added / np.where(seen, orthogonal, 1.0), 0.0))


def _places(offered: Sequence[Candidate]) -> dict[str, slice]:
    """Where the forms of each effect stand; they stand side by side."""
    places: dict[str, slice] = {}
    for number, candidate in enumerate(offered):
        name = candidate.effect.name
        places[name] = slice(places[name].start if name in places else number, number + 1)
    return places


def _side_by_side(places: Sequence[slice]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Numbers of the forms of each effect, shape (effects, most forms), and which of them there are."""
    starts = np.array([place.start for place in places], dtype=np.int64)
    counts = np.array([place.stop - place.start for place in places], dtype=np.int64)
    number = np.arange(counts.max(initial=1))
    there = number < counts[:, None]
    return np.where(there, starts[:, None] + number, starts[:, None]), there


def _directions(columns: FloatArray) -> FloatArray:
    """Orthonormal directions that columns span."""
    length = np.linalg.norm(columns, axis=0)
    seen = length > SINGULAR * length.max()
    left, values, _ = np.linalg.svd(columns[:, seen] / length[seen], full_matrices=False)
    return np.asarray(left[:, values > _ABSORBED * values[0]])
