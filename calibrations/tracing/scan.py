"""Which structure without a name a table shows: the likelihood of every component beside what was found already.

Whitened rows beside the columns of the model are split once. With F the columns of a component there, one eigen-
decomposition of F'F gives the likelihood for every ratio of its variance to that of a dwell.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Axis, Component, penalty
from tumble.calibrations.tracing.effect import Form
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.seen import beside, directions
from tumble.calibrations.tracing.table import Table
from tumble.messages import Message

_RATIOS: Final = 10.0 ** np.arange(-4.0, 5.1, 0.25)
"""Of the variance of a row by the component to that of a dwell."""


@dataclass(frozen=True, kw_only=True)
class Proposal:
    """A component that the table shows."""

    component: Component
    gain: float
    """Fall of -2 ln L."""
    variance: float
    """Mean variance of a row by it, in units of the variance of a dwell."""

    @property
    def worth(self) -> float:
        """The same beyond the penalty."""
        return self.gain - self.component.penalty


@dataclass(frozen=True, kw_only=True)
class Beside:
    """Weighted, whitened rows beside all columns of the model, as sums over rows may be made of them."""

    root: FloatArray
    """Roots of the weights, shape (rows,)."""
    taken: FloatArray
    """Directions that noise or model take, shape (rows, n): of columns F of weighted rows, F'F - (F'T)(F'T)' is left."""
    left: FloatArray
    """What is left of the output, made white twice, shape (rows,)."""
    squares: float
    """Sum of squares of what is left."""


def seen_beside(table: Table, forms: Sequence[Form], noise: NoiseModel) -> Beside:
    """The rows beside the declared model, linearised at its fit, and the forms in a noise."""
    root, white = np.sqrt(table.weights), table.memory.whitening(noise)
    theta = table.fit(forms, noise).theta
    slopes = table.model.slopes(theta[: table.model.parameters])
    columns = np.column_stack([table.declared @ slopes, *(form.columns for form in forms)])
    span = directions(white(columns * root[:, None]))
    everything = np.column_stack([table.declared, *(form.columns for form in forms)])
    misfit = white((table.output - everything @ table.model.coefficients(theta)) * root)
    rest = beside(span, misfit)
    return Beside(
        root=root,
        taken=np.column_stack([white.taken, white(span)]),
        left=white(rest),
        squares=float(rest @ rest),
    )


class Scan:
    """Everything without a name that a table could show, ready to be tried beside anything.

    `chance` is that at which a table without structure is given any, shared by all that is tried.
    """

    def __init__(self, table: Table, axes: Sequence[Axis], chance: float) -> None:
        self._rows = table.rows
        self._families = [_Family(axis, chance / max(len(axes), 1)) for axis in axes]

    def proposals(self, beside_: Beside) -> list[Proposal]:
        """The best component of every axis that shows any, the best first."""
        found = [best for family in self._families if (best := family.best(beside_, self._rows)) is not None]
        return sorted(found, key=lambda proposal: -proposal.worth)


class _Family:
    """A channel along a variable, in every shape."""

    def __init__(self, axis: Axis, chance: float) -> None:
        self._axis, self._chance = axis, chance
        bins = axis.coordinate.bins
        self._order = np.argsort(bins, kind="stable")
        self._starts = np.flatnonzero(np.diff(bins[self._order], prepend=-1))

    def best(self, seen: Beside, rows: int) -> Proposal | None:
        """The shape that gains most beyond its penalty; None where none gains anything."""
        return max(self._tried(seen, rows), key=lambda proposal: proposal.worth, default=None)

    def _tried(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        yield from self._courses(seen, rows)
        if self._axis.coordinate.waves and len(self._axis.coordinate.turns):
            yield from self._wave(seen, rows)
        if self._axis.coordinate.steps:
            yield from self._step(seen, rows)

    def _courses(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Gaussian processes of every length."""
        coordinate, level = self._axis.coordinate, self._axis.channel.gain * seen.root
        weighted = np.column_stack([seen.taken, seen.left]) * level[:, None]
        sums = np.add.reduceat(weighted[self._order], self._starts, axis=0)
        power = np.bincount(coordinate.bins, level**2)
        gram, with_output = np.diag(power) - sums[:, :-1] @ sums[:, :-1].T, sums[:, -1]
        for shape, root in coordinate.courses:
            values, vectors = np.linalg.eigh(root.T @ gram @ root)
            scale = float(power @ np.sum(root**2, axis=1)) / rows
            power_along = (vectors.T @ (root.T @ with_output)) ** 2
            (gain,), (variance,) = _gains(values[None] / scale, power_along[None] / scale, seen.squares, rows)
            yield self._proposed(shape, root[coordinate.bins], (gain, variance), len(coordinate.courses))

    def _wave(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Waves of any phase, up to the Nyquist limit."""
        sines, cosines = self._axis.coordinate.swing
        level = (self._axis.channel.gain * seen.root)[:, None]
        pair = np.stack([sines * level, cosines * level], axis=-1)
        taken = np.einsum("rwi,rt->wit", pair, seen.taken, optimize=True)
        gram = np.einsum("rwi,rwj->wij", pair, pair, optimize=True) - taken @ np.swapaxes(taken, 1, 2)
        with_output = np.einsum("rwi,r->wi", pair, seen.left, optimize=True)
        values, vectors = np.linalg.eigh(gram)
        scale = float(np.sum(level**2)) / rows
        power = np.einsum("wji,wj->wi", vectors, with_output) ** 2
        gains, variances = _gains(values / scale, power / scale, seen.squares, rows)
        best = int(np.argmax(gains))
        columns = np.column_stack([sines[:, best], cosines[:, best]])
        yield self._proposed(
            f"wave {self._axis.coordinate.turns[best]:g}",
            columns,
            (gains[best], variances[best]),
            len(self._axis.coordinate.turns),
        )

    def _step(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """A step between any two of its places."""
        places, steps = self._axis.coordinate.stepping
        level = (self._axis.channel.gain * seen.root)[:, None]
        columns = steps * level
        squares = np.sum(columns**2, axis=0) - np.sum((seen.taken.T @ columns) ** 2, axis=0)
        scale = float(np.sum(level**2)) / rows
        power = (seen.left @ columns) ** 2
        gains, variances = _gains(squares[:, None] / scale, power[:, None] / scale, seen.squares, rows)
        best = int(np.argmax(gains))
        yield self._proposed(f"step {places[best]:g}", steps[:, [best]], (gains[best], variances[best]), len(places))

    def _proposed(self, shape: str, columns: FloatArray, gained: tuple[float, float], tried: int) -> Proposal:
        """A shape with its gain and variance, one of so many of its kind; kinds share the chance of the axis."""
        axis = self._axis
        kinds = 1 + axis.coordinate.waves + axis.coordinate.steps
        component = Component(
            channel=axis.channel,
            coordinate=axis.coordinate,
            shape=shape,
            columns=columns * axis.channel.gain[:, None],
            penalty=penalty(self._chance / kinds / tried),
            described=Message("{channel}, {variable}", channel=axis.channel.phrase, variable=axis.coordinate.phrase),
        )
        return Proposal(component=component, gain=float(gained[0]), variance=float(gained[1]))


def _gains(values: FloatArray, power: FloatArray, squares: float, rows: int) -> tuple[FloatArray, FloatArray]:
    """Fall of -2 ln L of components with n columns each, and the ratio of variances at which it is; shape (components,).

    `values` are the eigenvalues of F'F for columns with a mean square of one in a row, shape (components, n), `power`
    the squares of the output along its eigenvectors, `squares` what is left of the output without them.
    """
    loaded = 1.0 + _RATIOS[:, None] * np.clip(values, 0.0, None)[:, None, :]
    fall = np.sum(_RATIOS[:, None] * power[:, None, :] / loaded, axis=-1)
    part = np.clip(fall / squares, 0.0, 1.0 - 1e-12)
    gains = -rows * np.log1p(-part) - np.sum(np.log(loaded), axis=-1)
    best = np.argmax(gains, axis=1)
    return np.take_along_axis(gains, best[:, None], axis=1)[:, 0], _RATIOS[best]
