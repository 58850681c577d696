"""One explanation of a table, and what it says of rows that are not there yet."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.tracing.continued import continued_noise
from tumble.calibrations.tracing.effect import Structure
from tumble.calibrations.tracing.noise import Whitening
from tumble.calibrations.tracing.quantified import form_in, tangent
from tumble.calibrations.tracing.table import Extensible, View
from tumble.calibrations.tracing.trace import Found, Trace

_RANK = 1e-9
"""Directions in which columns differ by less than this part of their length are one."""
_ALLOWED = 16.0
"""A form that misses no more of an effect than this, in -2 ln L, is not refuted by the table."""
_UNSEEN = 1e-4
"""Of a change of the effect less than this part is seen: the table says nothing of it."""
_BETWEEN = 3
"""So many values are tried between two of what is scanned for."""
_BEYOND = 1.35
"""What is scanned for is found up to so many times the greatest of the values, or as small a part of the least."""


class Prediction:
    """A trace as it fits the table, seen from the alpha0 from which effects are seen in the table.

    Where alpha0 rests on a curvature alone, its best value may be degrees from the truth, and what further rows are
    expected to show would be as far off.

    Parameters
    ----------
    base
        The table.
    trace
        The whole of what explains it.
    name
        The effect, one of the trace, in whose place other explanations have another.
    """

    def __init__(self, base: Extensible, trace: Trace, name: str) -> None:
        self._base, self._noise, self._components = base, trace.noise, trace.components
        functions = np.column_stack([base.declared, *(form.columns for form in trace.forms)])
        whiten, size = base.memory.whitening(trace.noise), base.model.parameters
        theta = base.model.near(compress(functions, base.output, base.weights, whiten))
        self.theta: FloatArray = theta[:size]
        """Declared parameters."""
        best = base.fit(trace.forms, trace.noise)
        self.dwell_v = float(np.sqrt(best.squares / max(base.rows - len(best.theta), 1)))
        """Noise of a dwell, in volts, by the best alpha0: another one leaves more."""
        self._residual_v = base.output - functions @ base.model.coefficients(theta)
        ends = np.cumsum([form.columns.shape[1] for form in trace.forms], dtype=int)
        found = list(zip(trace.found, np.split(theta[size:], ends[:-1]), strict=False))
        self._own = [(item, values) for item, values in found if item.effect.name == name]
        self._beside = [(item, values) for item, values in found if item.effect.name != name]
        self._name = name
        self._spread = self._principal_changes()
        self._grid = self._scanned(base.scene)
        self._allowed = self._not_refuted()

    def output_v(self, scene: View) -> FloatArray:
        """What the effect adds to the output, shape (rows,)."""
        if not self._own:
            return self._random_v(scene)
        return np.asarray(sum(_columns(scene, item)[:, : len(values)] @ values for item, values in self._own))

    def signal(self, scene: View) -> FloatArray:
        """What the effect adds to the output, in standard deviations of a dwell, shape (rows, 1 + n).

        First as it was fitted, then how much each of n independent standard uncertainties of the fit would change it.
        """
        changes = self._followed(scene, self._own) @ self._spread
        return np.asarray(np.column_stack([self.output_v(scene), changes]) / self.dwell_v)

    def left(self, scene: View, weights: FloatArray, signals: Sequence[FloatArray]) -> list[FloatArray]:
        """What this explanation cannot follow of each signal, of the same shape, weighted and whitened.

        It may take any form of the effect that the table allows, or that only more rows bring up.
        """
        new = [value for value in self._scanned(scene) if value > 1.01 * max(self._grid)]
        own = [_columns(scene, item) for item, _ in self._own]
        forms = [np.column_stack([np.empty((scene.rows, 0)), *own])]
        forms += [self._form(scene, value) for value in (*self._allowed, *new)]
        columns, ends = np.column_stack(signals), np.cumsum([each.shape[1] for each in signals])
        rests = [np.split(rest, ends[:-1], axis=1) for rest in self._rests(scene, weights, columns, forms)]
        return [min(each, key=_of_the_fit) for each in zip(*rests, strict=True)]

    def _rests(
        self, scene: View, weights: FloatArray, outputs: FloatArray, forms: Iterable[FloatArray]
    ) -> Iterator[FloatArray]:
        """The same for each form of the effect by itself."""
        root = np.sqrt(weights)[:, None]
        whiten = self._whitening(scene, weights)
        declared = self._base.functions(scene) @ self._base.model.slopes(self.theta)
        beside = whiten(np.column_stack([declared, self._followed(scene, self._beside)]) * root)
        span = _directions(beside, np.linalg.norm(beside, axis=0))
        free = _off(span, whiten(outputs * root))
        for form in forms:
            columns = whiten(form * root)
            added = _directions(_off(span, columns), np.linalg.norm(columns, axis=0))
            yield _off(added, free)

    def _principal_changes(self) -> FloatArray:
        """Independent changes of what was fitted of the effect, a standard uncertainty each, shape (fitted, n).

        Without the directions of which the table says nothing at all.
        """
        base, scene = self._base, self._base.scene
        root, own = np.sqrt(base.weights)[:, None], self._followed(scene, self._own)
        whiten = base.memory.whitening(self._noise)
        declared = base.declared @ base.model.slopes(self.theta)
        beside = whiten(np.column_stack([declared, self._followed(scene, self._beside)]) * root)
        span = _directions(beside, np.linalg.norm(beside, axis=0))
        length = np.linalg.norm(own * root, axis=0)
        length = np.where(length > 0, length, 1.0)
        seen = _off(span, whiten(own * root)) / length
        _, values, turned = np.linalg.svd(seen, full_matrices=False)
        kept = values > _UNSEEN
        return np.asarray(turned[kept].T / values[kept] / length[:, None] * self.dwell_v)

    def _scanned(self, scene: View) -> list[float]:
        """Values to try of what is scanned for, where that is a continuous quantity."""
        if len(self._own) != 1 or self._own[0][0].effect.at is None:
            return []
        effect = self._own[0][0].effect
        return _filled([value for form in effect.forms(scene) for value in form.scanned.values()])

    def _not_refuted(self) -> list[float]:
        """Scanned values with which the effect could be what it is in the table."""
        scene = self._base.scene
        forms = [self._form(scene, value) for value in self._grid]
        if not forms:
            return []
        output = self.output_v(scene)[:, None] / self.dwell_v
        rests = self._rests(scene, self._base.weights, output, forms)
        return [value for value, rest in zip(self._grid, rests, strict=True) if np.sum(rest**2) < _ALLOWED]

    def _form(self, scene: View, value: float) -> FloatArray:
        """The effect at another scanned value."""
        at = self._own[0][0].effect.at
        assert at is not None
        return at(scene, value).columns

    @staticmethod
    def _followed(scene: View, items: Iterable[tuple[Found, FloatArray]]) -> FloatArray:
        """Columns of effects and of the change of what was scanned, shape (rows, n)."""
        columns = [np.empty((scene.rows, 0))]
        for item, values in items:
            change = tangent(scene, item, values)
            columns += [_columns(scene, item), *([] if change is None else [change])]
        return np.column_stack(columns)

    def _random_v(self, scene: View) -> FloatArray:
        """A random effect, as it was in the table.

        A level that is not known yet is taken as the mean of the others, a walk to stay where it is.
        """
        root = np.sqrt(self._base.weights)
        residual = self._residual_v * root
        for effect in self._base.effects:
            if effect.name == self._name:
                seen, further = (effect.forms(view)[0].columns for view in (self._base.scene, scene))
                levels = np.linalg.lstsq(seen * root[:, None], residual, rcond=None)[0]
                return np.asarray(further[:, : len(levels)] @ levels)
        whiten = self._base.memory.whitening(self._noise)
        walk_v = (residual - whiten(whiten(residual))) / root
        return np.pad(walk_v, (0, scene.rows - len(walk_v)), mode="edge")

    def _whitening(self, scene: View, weights: FloatArray) -> Whitening:
        """What makes the noise of this explanation white."""
        memory, noise = continued_noise(self._base, self._noise, self._components, scene, weights)
        return memory.whitening(noise)


def _filled(values: Sequence[float]) -> list[float]:
    """Values with others between them, and beyond them as far as the search goes."""
    if not values:
        return []
    ends = [_beyond(min(values), 1.0 / _BEYOND), *sorted(values), _beyond(max(values), _BEYOND)]
    return [*np.concatenate([_between(*pair) for pair in pairwise(ends)]).tolist(), ends[-1]]


def _beyond(value: float, ratio: float) -> float:
    """A value so many times as large; a threshold below zero goes as far the same way."""
    return value * ratio if value > 0.0 else value / ratio


def _between(low: float, high: float) -> FloatArray:
    """Values from one to before the next, by equal ratios, or across zero by equal steps."""
    spaced = np.geomspace if low * high > 0.0 else np.linspace
    return np.asarray(spaced(low, high, _BETWEEN + 1)[:-1])


def _columns(scene: View, item: Found) -> FloatArray:
    """Columns of an effect found in another scene. What has no name is not expected to come back."""
    if isinstance(item.effect, Structure):
        return _longer(item.form.columns, scene.rows)
    return form_in(scene, item).columns


def _longer(columns: FloatArray, rows: int) -> FloatArray:
    """Columns for more rows, in which there is nothing of them."""
    return np.pad(columns, ((0, rows - len(columns)), (0, 0)))


def _directions(columns: FloatArray, length: FloatArray) -> FloatArray:
    """Orthonormal directions that columns span; what is left of one is nothing beside the `length` that it had."""
    left, values, _ = np.linalg.svd(columns / np.where(length > 0, length, 1.0), full_matrices=False)
    return np.asarray(left[:, values > _RANK])


def _off(span: FloatArray, columns: FloatArray) -> FloatArray:
    """What is left of columns beside orthonormal directions."""
    return np.asarray(columns - span @ (span.T @ columns))


def _of_the_fit(rest: FloatArray) -> float:
    """Squared length of what is left of a signal as it was fitted."""
    return float(np.sum(rest[:, 0] ** 2))
