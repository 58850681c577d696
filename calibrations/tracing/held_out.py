"""The error before and after, on rows that neither chose an effect nor fitted its coefficients."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import compress
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.adequacy import told_without
from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.noise import WHITE, NoiseModel
from tumble.calibrations.tracing.penalties import CLOSE
from tumble.calibrations.tracing.problem import Problem
from tumble.calibrations.tracing.sample import Sample
from tumble.calibrations.tracing.search import search
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Trace, Tracer
from tumble.calibrations.tracing.whitened import Fitted

_FAR: Final = 4.0
"""So many times the variance of a prediction of the declared model, or of a dwell, is far off the rows."""
_HALF: Final = 0.5
"""Rivals that differ by less than this part of what is mended are of use whichever is true."""
_FORMS: Final = 8
"""So many other forms of an effect are tried."""
_RANK: Final = 1e-10
_INNER_FOLDS: Final = 3
"""Into so many folds of whole settings the other rows are parted, to decide by what they predict."""


def held_out_rms(tracer: Tracer[Any], trace: Trace, parts: Iterable[BoolArray]) -> float | None:
    """Root mean square error of predicting each of the parts, rows held out, after a search among the others.

    Effects are chosen anew from the other rows, from their scans as they stand, in the noise of the whole table. What
    has no name is predicted by its mean given the other rows; what is random (levels, a walk) cannot be, and
    counts as error. So does what those rows do not tell well enough to predict the part. Where folds of the other
    rows are predicted better by the declared model alone, or where they do not tell which of two effects that predict
    the part otherwise is there, the declared model alone predicts it.
    Parts without which the others do not tell the declared model are passed over; None where that is every one.
    """
    table = tracer.table
    columns = table.declared @ table.model.slopes(table.fit((), trace.noise).declared)
    errors = [_errors(tracer, trace, out) for out in parts if told_without(columns, out)]
    return float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) if errors else None


def _errors(tracer: Tracer[Any], trace: Trace, out: BoolArray) -> FloatArray:
    """Output minus what the other rows predict, of the rows that are held out."""
    table, nothing = tracer.table, np.empty((tracer.table.rows, 0))
    alone = _Shown(table, WHITE, (), nothing)
    chosen, *swapped = _chosen(tracer, trace, out)
    theta = _Shown(table, trace.noise, trace.components, np.column_stack([nothing, *chosen])).theta(~out)
    told, found = (_told_part(table, each, out, theta) for each in (chosen, [form.columns for form in trace.forms]))
    rivals = swapped if len(found) == len(trace.forms) else [*swapped, found]
    shown, *others = [
        _Shown(table, trace.noise, trace.components, np.column_stack([nothing, *each])) for each in (told, *rivals)
    ]
    if not _agreed(shown, alone, others, out):
        return alone.errors(~out, out)
    inner = _inner_folds(table, out)
    better = sum(shown.squares(train, test) - alone.squares(train, test) for train, test in inner) <= 0.0
    return (shown if better else alone).errors(~out, out)


def _told_part(table: Table, forms: Sequence[FloatArray], out: BoolArray, theta: FloatArray) -> list[FloatArray]:
    """Of forms, in the order in which they were found, those that the other rows tell with the ones before them."""
    if _told(table, np.column_stack([np.empty((table.rows, 0)), *forms]), out, theta):
        return list(forms)
    kept: list[FloatArray] = []
    for form in forms:
        if _told(table, np.column_stack([*kept, form]), out, theta):
            kept.append(form)
    return kept


def _agreed(shown: "_Shown", alone: "_Shown", rivals: Sequence["_Shown"], out: BoolArray) -> bool:
    """Whether other explanations of the other rows predict the rows held out alike.

    That is to within the scatter of rows, or half of what the explanation mends of the declared model's prediction.
    """
    if not rivals:
        return True
    errors = shown.errors(~out, out)
    scatter, mended = shown.errors(~out, ~out), errors - alone.errors(~out, out)
    allowed = max(float(np.mean(scatter**2)), _HALF**2 * float(np.mean(mended**2)))
    return all(float(np.mean((errors - rival.errors(~out, out)) ** 2)) <= allowed for rival in rivals)


def _told(table: Table, columns: FloatArray, out: BoolArray, theta: FloatArray) -> bool:
    """Whether the other rows tell columns so well that no row held out is extrapolated to.

    So it must be from the declared parameters of the whole table, and from those that the other rows give with the
    columns, `theta`: there another alpha0 may stand for what the columns do.
    """
    tangents = [table.declared @ table.model.slopes(each) for each in (table.fit((), WHITE).declared, theta)]
    allowed = _FAR * max(_leverage(tangents[0], out), 1.0)
    together = [np.column_stack([tangent, columns]) for tangent in tangents]
    return all(told_without(each, out) and _leverage(each, out) < allowed for each in together)


def _leverage(columns: FloatArray, out: BoolArray) -> float:
    """Largest variance of a prediction of rows held out, in variances of a dwell."""
    length = np.linalg.norm(columns, axis=0)
    scaled = columns / np.where(length > 0, length, 1.0)
    inverse = np.linalg.pinv(scaled[~out], rcond=_RANK)
    return float(np.max(np.sum((scaled[out] @ inverse) ** 2, axis=1), initial=0.0))


def _chosen(tracer: Tracer[Any], trace: Trace, out: BoolArray) -> list[list[FloatArray]]:
    """Effects that the other rows choose, and sets that they do not refute: the columns of each, shapes (rows, n)."""
    table = tracer.table
    barred = [candidate.effect.random or candidate.effect.name in tracer.barred for candidate in tracer.offered]
    offered = [] if table.not_traced else list(compress(tracer.offered, np.logical_not(barred)))
    sample = table.sample_in(trace.noise, ~out)
    problem = Problem(
        sample.whitened_fit(trace.noise), sample.turned(tracer.columns[~out]), offered, table.most_effects
    )
    chosen = search(problem, beam=3).chosen
    return [
        [np.asarray(tracer.columns[:, problem.columns_of((form,))]) for form in each]
        for each in (chosen, *_swapped(problem, chosen))
    ]


def _swapped(problem: Problem, chosen: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The candidates chosen with each other one in the place of one that explains nearly as much.

    Another effect in its best form, or the same in another: among fewer angles a division error of one order looks like
    one of another.
    """
    for number in chosen:
        rest = tuple(other for other in chosen if other != number)
        worth = problem.gains(problem.explain(rest)) - problem.penalties
        taken, own = {problem.offered[other].effect.name for other in chosen}, problem.offered[number].effect.name
        others = [rival for rival in problem.best_forms(worth) if problem.offered[rival].effect.name not in taken]
        place = problem.forms[own]
        forms = sorted(set(range(place.start, place.stop)) - set(chosen), key=lambda form: -worth[form])[:_FORMS]
        for rival in (*others, *forms):
            if worth[rival] > worth[number] - CLOSE:
                yield (*rest, rival)


def _inner_folds(table: Table, out: BoolArray) -> list[tuple[BoolArray, BoolArray]]:
    """Rows to fit and rows to predict, of those that are not held out; whole settings together."""
    fold = np.unique(table.blocks("angle")[~out], return_inverse=True)[1] % _INNER_FOLDS
    parts = [np.zeros(table.rows, dtype=bool) for _ in range(_INNER_FOLDS)]
    for number, part in enumerate(parts):
        part[~out] = fold == number
    columns = table.declared @ table.model.slopes(table.fit((), WHITE).declared)
    return [(~out & ~part, part) for part in parts if part.any() and told_without(columns[~out], part[~out])]


class _Shown:
    """A table with columns, and structure without a name, in a noise: what some rows predict of others."""

    def __init__(self, table: Table, noise: NoiseModel, components: Sequence[Component], columns: FloatArray) -> None:
        self._table, self._noise, self._columns = table, noise, columns
        self._drawn = [(table.memory.levels[each.name], dict(noise.levels)[each.name]) for each in components]

    def squares(self, train: BoolArray, test: BoolArray) -> float:
        """Sum of squares of the errors."""
        return float(np.sum(self.errors(train, test) ** 2))

    def theta(self, train: BoolArray) -> FloatArray:
        """Declared parameters that the rows of `train` give."""
        return self._fitted(train)[1].declared

    def _fitted(self, train: BoolArray) -> tuple[Sample, Fitted]:
        sample = self._table.sample_in(self._noise, train)
        whitened_fit = sample.whitened_fit(self._noise)
        return sample, whitened_fit.fit(whitened_fit.split(sample.turned(self._columns[train])))

    def errors(self, train: BoolArray, test: BoolArray) -> FloatArray:
        """Output minus what the rows of `train` predict, of the rows of `test`."""
        table, (sample, fit) = self._table, self._fitted(train)
        together = np.column_stack([table.declared, self._columns])
        misfit = table.output - together @ table.model.coefficients(fit.theta)
        white = sample.memory.whitening(self._noise)
        shown = white(white(misfit[train] * sample.root_weights))
        unnamed = sum((variance * level[test] @ (level[train].T @ shown) for level, variance in self._drawn), 0.0)
        return np.asarray(misfit[test] - unnamed / np.sqrt(table.weights[test]))
