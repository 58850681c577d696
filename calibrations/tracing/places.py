"""How far an experiment would part the places where structure without a name may live: channels and variables.

To each place belongs a covariance of the rows. Given the table, a place expects of further rows a mean m and a
covariance S. If A is the true one, -2 ln L of B is expected to grow beyond that of A by

    (m_A - m_B)' S_B⁻¹ (m_A - m_B) + tr(S_B⁻¹ S_A) - n - ln(det S_A / det S_B),

twice the divergence of Kullback and Leibler, with the variance of that quadratic form: the prediction knows its noise.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.continued import continued_noise
from tumble.calibrations.tracing.noise import WHITE
from tumble.calibrations.tracing.penalties import NEAR
from tumble.calibrations.tracing.quantified import form_in
from tumble.calibrations.tracing.separation import COVERAGE, Expected, PlannedRows
from tumble.calibrations.tracing.table import Extensible, View
from tumble.calibrations.tracing.trace import Trace

_FREE: Final = 1e-4
"""Inverse of how far, in standard deviations of a dwell, the declared model may go."""


def place_name(trace: Trace) -> str:
    """Channel and variable of the largest structure without a name: `offset × time`."""
    return " × ".join(trace.components[0].place)


def by_place(trace: Trace, others: Sequence[Trace]) -> Mapping[str, Trace]:
    """The nearest explanation of every place, that of the trace itself first."""
    return {place_name(each): each for each in reversed((trace, *others))} if trace.components else {}


def places(trace: Trace, others: Sequence[Trace]) -> tuple[str, ...]:
    """Names of the places where the structure of a trace may live, its own first; none without structure."""
    nearest = by_place(trace, others)
    return tuple(sorted(nearest, key=lambda name: nearest[name] is not trace))


class PlaceQuestion:
    """On which channel and variable structure without a name lives: where it was found, or in another place.

    Parameters
    ----------
    base, trace
        The table, and what it was traced to.
    others
        The same with another component, which the rows do not part from it.
    """

    needed = NEAR
    """In -2 ln L: what is further behind is not listed any more."""

    def __init__(self, base: Extensible, trace: Trace, others: Sequence[Trace]) -> None:
        self.name, *rivals = places(trace, others)
        self.rivals = tuple(rivals)
        self.table = PlannedRows.of(base)
        nearest = by_place(trace, others)
        seen = [_Place(base=base, trace=nearest[name]) for name in (self.name, *rivals)]
        self._found, self._rivals = seen[0], seen[1:]
        self.behind = np.array([each.deviance - self._found.deviance for each in self._rivals])

    def outlook(self, rows: PlannedRows, programme: str, apart: list[int], sure: bool) -> None:
        """Nothing to be drawn: places differ in covariances."""

    def belongs_to(self, name: str) -> str:  # noqa: ARG002
        """Owner of what has no name: nobody knows."""
        return "unit"

    def expected(self, rows: PlannedRows) -> Expected:
        """Differences in -2 ln L once further rows are there: expected, and what they will hardly stay below."""
        if len(rows.weights) == len(self.table.weights):
            there = np.array([self.behind, -self.behind])
            return Expected(separations=np.zeros((2, len(self.rivals))), promises=there, likely=there)
        found, others = self._found.further(rows), [each.further(rows) for each in self._rivals]
        pairs = np.array([[found.against(each) for each in others], [each.against(found) for each in others]])
        now = np.array([self.behind, -self.behind])
        likely = now + pairs[..., 0]
        return Expected(separations=likely, promises=likely - COVERAGE * pairs[..., 1], likely=likely)


@dataclass(frozen=True, kw_only=True)
class _Further:
    """What a place expects of further rows, in standard deviations of a dwell: a mean, and a covariance 1 + PP'."""

    mean: FloatArray
    """Shape (rows,)."""
    spread: FloatArray
    """P, shape (rows, n)."""

    def against(self, other: "_Further") -> tuple[float, float]:
        """By how much -2 ln L of another place grows beyond that of this one if this is true: mean and deviation."""
        apart = (self.mean - other.mean)[:, None]
        directions = np.linalg.qr(np.column_stack([self.spread, other.spread, apart])).Q
        own, theirs = (directions.T @ each.spread for each in (self, other))
        root = np.linalg.cholesky(np.eye(len(theirs)) + theirs @ theirs.T)
        seen = np.linalg.solve(root, np.column_stack([np.eye(len(own)), own, directions.T @ apart]))
        width = len(own)
        mixed = seen[:, :-1] @ seen[:, :-1].T
        shift = seen[:, -1]
        values = np.clip(np.linalg.eigvalsh(mixed), 1e-12, None)
        mean = float(shift @ shift + values.sum() - width - np.log(values).sum())
        return mean, float(np.sqrt(4.0 * shift @ mixed @ shift + 2.0 * np.sum((values - 1.0) ** 2)))


@dataclass(frozen=True, kw_only=True)
class _Place:
    """A table with one structure without a name, as a linear model with independent coefficients of variance one."""

    base: Extensible
    trace: Trace

    @cached_property
    def _theta(self) -> FloatArray:
        return self.base.fit((), WHITE).declared

    @cached_property
    def _dwell(self) -> float:
        """Standard deviation of a dwell, in the unit of the output."""
        best = self.base.with_seen(self.trace.components).fit(self.trace.forms, self.trace.noise)
        return float(np.sqrt(best.squares / max(self.base.rows - len(best.theta), 1)))

    @cached_property
    def _output(self) -> FloatArray:
        """What the declared model leaves, weighted, in standard deviations of a dwell, shape (rows,)."""
        left = self.base.output - self.base.declared @ self.base.model.coefficients(self._theta)
        return np.asarray(left * np.sqrt(self.base.weights) / self._dwell)

    @property
    def deviance(self) -> float:
        """-2 ln L of the table with the penalty of the structure, up to a constant of the table."""
        columns = self._columns(self.base.scene, self.base.weights)
        root, solved = self._solved(columns)
        squares = self._output @ self._output - solved @ solved
        return float(
            self.base.rows * np.log(squares * self._dwell**2)
            + 2.0 * np.sum(np.log(np.diag(root)))
            + self.trace.components[0].penalty
        )

    def _columns(self, scene: View, weights: FloatArray) -> FloatArray:
        """Everything that rows may follow: declared model and effects, nearly free, then noise and structure."""
        slopes = self.base.functions(scene) @ self.base.model.slopes(self._theta)
        changes = [form_in(scene, item).columns for item in self.trace.found]
        free = np.column_stack([slopes, *changes]) * np.sqrt(weights)[:, None]
        free = free / np.linalg.norm(free, axis=0).clip(1e-300) * np.sqrt(len(free))
        memory, noise = continued_noise(self.base, self.trace.noise, self.trace.components, scene, weights)
        return np.column_stack([free / _FREE, memory.drawn(noise)])

    def _solved(self, columns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Root R of RR' = 1 + C'C for columns C of the table, and R⁻¹C'y."""
        root = np.asarray(np.linalg.cholesky(np.eye(columns.shape[1]) + columns.T @ columns))
        return root, np.asarray(np.linalg.solve(root, columns.T @ self._output))

    def further(self, rows: PlannedRows) -> _Further:
        """What it expects of the rows after those of the table."""
        columns = self._columns(self.base.view(rows.rows, self._theta), rows.weights)
        known, new = columns[: self.base.rows], columns[self.base.rows :]
        root, solved = self._solved(known)
        spread = np.asarray(np.linalg.solve(root, new.T).T)
        return _Further(mean=spread @ solved, spread=spread)
