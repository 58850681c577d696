"""Everything that a residual may be traced to in one table: effects in all their forms, as columns side by side."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.solutions import SINGULAR
from tumble.calibrations.tracing.effect import Effect, Form, Structure
from tumble.calibrations.tracing.penalties import ANOTHER_SHAPE, FALSE_ALARM, SHAPE_UNNAMED, of_columns
from tumble.calibrations.tracing.table import Table

_NARROW = 2
_REST = 0.02
"""Part of a column's square that must not lie in the two rows that show most of it."""


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """One form of one effect, and where its columns stand among all columns."""

    effect: Effect[Any]
    form: Form
    columns: slice
    penalty: float
    """By how much -2 ln L must fall for the effect to be believed, all forms that were tried counted."""
    repeat_penalty: float
    """The same for a second form of an effect that is there already: its shape need not be one of the catalogue's."""
    chance: float
    """At which this form would be found where it is not."""

    @property
    def coefficients(self) -> int:
        """How many numbers are fitted: columns, and what was scanned for."""
        return int(self.form.columns.shape[1]) + len(self.form.scanned)


def candidates(table: Table) -> tuple[Candidate, ...]:
    """All forms of all effects and structures that a table can show at all, beside its declared model."""
    left, values, _ = np.linalg.svd(table.declared, full_matrices=False)
    span = left[:, values > SINGULAR * values[0]]
    shown = (
        (effect, [form for form in effect.forms(table.scene) if _seen_in_several_rows(form, span)])
        for effect in (*table.effects, *table.structures)
    )
    tried = [(effect, forms) for effect, forms in shown if forms]
    return tuple(_numbered(tried, table.rows, table.rows - table.model.parameters))


def _numbered(tried: Sequence[tuple[Effect[Any], Sequence[Form]]], rows: int, spare: int) -> Iterator[Candidate]:
    """All of them, side by side; of the rows, `spare` more than the declared model needs."""
    start = 0
    for effect, forms in tried:
        chance, second = FALSE_ALARM / len(tried) / len(forms), ANOTHER_SHAPE / len(forms)
        handicap = SHAPE_UNNAMED if isinstance(effect, Structure) else 0.0
        for form in forms:
            width = form.columns.shape[1]
            yield Candidate(
                effect=effect,
                form=form,
                columns=slice(start, start + width),
                penalty=of_columns(width, chance, rows, spare) + handicap + form.penalty,
                repeat_penalty=of_columns(width, second, rows, spare) + handicap + form.penalty,
                chance=_chance(len(tried) * len(forms), form.penalty),
            )
            start += width


def _seen_in_several_rows(form: Form, span: FloatArray) -> bool:
    """Whether what is left of each of one or two columns beside orthonormal directions rests on more than two rows.

    A shape that vanishes at all but a few settings, or is a function of the model at all but a few, would take the
    gross errors there for its own.
    """
    if form.columns.shape[1] > _NARROW:
        return True
    squares = (form.columns - span @ (span.T @ form.columns)) ** 2
    rest = np.sort(squares, axis=0)[:-2].sum(axis=0)
    return bool(np.all(rest >= _REST * squares.sum(axis=0)))


def _chance(tried: int, penalty: float) -> float:
    """Significance level of one of so many shapes; a penalty in -2 ln L changes its odds by exp(-penalty/2).

    What is expected rather than sought (penalty below 0) is no false alarm, and shares that chance with nothing.
    """
    return float(FALSE_ALARM / (tried if penalty >= 0.0 else 1) * np.exp(-penalty / 2.0))


def all_columns(offered: Sequence[Candidate], rows: int) -> FloatArray:
    """The columns of all candidates side by side, shape (rows, columns)."""
    return np.column_stack([np.empty((rows, 0)), *(candidate.form.columns for candidate in offered)])
