"""A table as one effect is seen in it beside everything else, linearised at the fit."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from calibrations.geometry import FloatArray
from calibrations.tracing.quantified import tangent
from calibrations.tracing.table import Table
from calibrations.tracing.trace import Found, Trace

SEEN: Final = 1e-5
"""Columns of which less than this part is left beside others are not seen."""


@dataclass(frozen=True, kw_only=True)
class Seen:
    """A table as one effect is seen in it, linearised at the fit, weighted and whitened."""

    others: FloatArray
    """Orthonormal directions of the declared model and of all other effects, shape (rows, n)."""
    own: FloatArray
    """Those of the effect beside them, shape (rows, k)."""
    left: FloatArray
    """The output beside the others, shape (rows,)."""
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
        shown = float(np.linalg.norm(beside(self.others, self.signal)))
        return float(np.linalg.norm(centred * self.root)) / max(shown, 1e-300)


def seen_by(table: Table, trace: Trace, name: str) -> Seen:
    """The effect of that name; where there is none, only what everything that was found leaves."""
    root, whiten = np.sqrt(table.weights), table.memory.whitening(trace.noise)
    fit = table.fit(trace.forms, trace.noise)
    declared, *sizes = _sizes(table, trace, fit.theta)
    other = [table.declared @ table.model.slopes(fit.theta)]
    own = [np.empty((table.rows, 0))]
    stated, rest = np.zeros(table.rows), table.declared @ declared
    for item, size in zip(trace.found, sizes, strict=True):
        its, share = item.effect.name == name, item.form.columns @ size
        (own if its else other).append(_with_tangent(table, item, size))
        stated, rest = (stated + share, rest) if its else (stated, rest + share)
    others = directions(whiten(np.column_stack(other) * root[:, None]))
    return Seen(
        others=others,
        own=_directions_beside(others, whiten(np.column_stack(own) * root[:, None])),
        left=beside(others, whiten((table.output - rest) * root)),
        signal=whiten(stated * root),
        stated=stated,
        root=root,
    )


def _sizes(table: Table, trace: Trace, theta: FloatArray) -> list[FloatArray]:
    """Coefficients of the declared functions, then those of each effect that was found."""
    widths = [table.declared.shape[1], *(form.columns.shape[1] for form in trace.forms)]
    return np.split(table.model.coefficients(theta), np.cumsum(widths)[:-1])


def _with_tangent(table: Table, item: Found, size: FloatArray) -> FloatArray:
    """Columns of an effect; what was scanned for counts as fitted."""
    change = tangent(table.scene, item, size)
    return item.form.columns if change is None else np.column_stack([item.form.columns, change])


def _directions_beside(others: FloatArray, columns: FloatArray) -> FloatArray:
    """Orthonormal directions of what is left of columns beside others."""
    length = np.linalg.norm(columns, axis=0)
    left = beside(others, beside(others, columns))
    return directions(left[:, np.linalg.norm(left, axis=0) > SEEN * length])


def beside(along: FloatArray, columns: FloatArray) -> FloatArray:
    """What is left of columns beside orthonormal directions, shape (rows, n)."""
    return np.asarray(columns - along @ (along.T @ columns))


def directions(columns: FloatArray) -> FloatArray:
    """Orthonormal directions that columns span, shape (rows, n)."""
    length = np.linalg.norm(columns, axis=0)
    seen = length > SEEN * length.max(initial=0.0)
    if not seen.any():
        return np.empty((len(columns), 0))
    left, values, _ = np.linalg.svd(columns[:, seen] / length[seen], full_matrices=False)
    return np.asarray(left[:, values > SEEN * values[0]])
