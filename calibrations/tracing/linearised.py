"""Partial regression: one effect of a table with everything else taken off, linearised at the fit."""

from dataclasses import dataclass
from itertools import compress
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.quantified import tangent
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Found, Trace

RESOLVED: Final = 1e-5
"""Columns of which less than this part is orthogonal to others are not resolved."""


@dataclass(frozen=True, kw_only=True)
class PartialRegression:
    """One effect and the output, orthogonal to everything else, linearised at the fit, weighted and whitened."""

    others: FloatArray
    """Orthonormal directions of the declared model and of all other effects, shape (rows, n)."""
    own: FloatArray
    """Those of the effect, orthogonal to them, shape (rows, k)."""
    left: FloatArray
    """The output, orthogonal to the others, shape (rows,)."""
    signal: FloatArray
    """What is stated of the effect, shape (rows,)."""
    stated: FloatArray
    """The same neither weighted nor whitened."""
    root: FloatArray
    """Roots of the weights, shape (rows,)."""

    @property
    def inflation(self) -> float:
        """Size of what is stated, a constant apart, over that of what no other column can follow."""
        centred = self.stated - np.average(self.stated, weights=self.root**2)
        shown = float(np.linalg.norm(orthogonal_to(self.others, self.signal)))
        return float(np.linalg.norm(centred * self.root)) / max(shown, 1e-300)


class Linearised:
    """A table with everything that was found, linearised at the fit, weighted and whitened."""

    def __init__(self, table: Table, trace: Trace) -> None:
        self.table, self.trace = table, trace
        self._root, self._white = np.sqrt(table.weights), table.memory.whitening(trace.noise)
        fit = table.fit(trace.forms, trace.noise)
        declared, *sizes = _sizes(table, trace, fit.theta)
        self._model = self._whitened(table.declared @ table.model.slopes(fit.theta))
        self._columns = [
            self._whitened(_with_tangent(table, item, size)) for item, size in zip(trace.found, sizes, strict=True)
        ]
        self._shares = [item.form.columns @ size for item, size in zip(trace.found, sizes, strict=True)]
        self._left = table.output - table.declared @ declared

    def partial(self, name: str) -> PartialRegression:
        """Partial regression on the effect of that name; where there is none, the residual of everything found."""
        its = [item.effect.name == name for item in self.trace.found]
        nothing = np.zeros(self.table.rows)
        stated = sum(compress(self._shares, its), nothing)
        rest = sum((share for share, own in zip(self._shares, its, strict=True) if not own), nothing)
        others = directions(
            np.column_stack([self._model, *(each for each, own in zip(self._columns, its, strict=True) if not own)])
        )
        own = np.column_stack([nothing[:, None][:, :0], *compress(self._columns, its)])
        return PartialRegression(
            others=others,
            own=_orthogonal_directions(others, own),
            left=orthogonal_to(others, self._white((self._left - rest) * self._root)),
            signal=self._white(stated * self._root),
            stated=stated,
            root=self._root,
        )

    def _whitened(self, columns: FloatArray) -> FloatArray:
        return self._white(columns * self._root[:, None])


def _sizes(table: Table, trace: Trace, theta: FloatArray) -> list[FloatArray]:
    """Coefficients of the declared functions, then those of each effect that was found."""
    widths = [table.declared.shape[1], *(form.columns.shape[1] for form in trace.forms)]
    return np.split(table.model.coefficients(theta), np.cumsum(widths)[:-1])


def _with_tangent(table: Table, item: Found, size: FloatArray) -> FloatArray:
    """Columns of an effect; what was scanned for counts as fitted."""
    change = tangent(table.scene, item, size)
    return item.form.columns if change is None else np.column_stack([item.form.columns, change])


def _orthogonal_directions(others: FloatArray, columns: FloatArray) -> FloatArray:
    """Orthonormal directions of the part of columns that is orthogonal to others."""
    length = np.linalg.norm(columns, axis=0)
    left = orthogonal_to(others, orthogonal_to(others, columns))
    return directions(left[:, np.linalg.norm(left, axis=0) > RESOLVED * length])


def orthogonal_to(basis: FloatArray, columns: FloatArray) -> FloatArray:
    """The part of columns that is orthogonal to an orthonormal basis, shape (rows, n)."""
    return np.asarray(columns - basis @ (basis.T @ columns))


def directions(columns: FloatArray) -> FloatArray:
    """Orthonormal directions that columns span, shape (rows, n)."""
    length = np.linalg.norm(columns, axis=0)
    resolved = length > RESOLVED * length.max(initial=0.0)
    if not resolved.any():
        return np.empty((len(columns), 0))
    left, values, _ = np.linalg.svd(columns[:, resolved] / length[resolved], full_matrices=False)
    return np.asarray(left[:, values > RESOLVED * values[0]])
