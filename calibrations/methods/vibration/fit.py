"""The coefficients beside what was found, by generalised least squares; effects that are not linear in full."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.vibration.effects.curved import CURVED, Curved
from tumble.calibrations.methods.vibration.model import COEFFICIENTS, NAMES, SUMS, UNIT, name_of
from tumble.calibrations.methods.vibration.scene import Point
from tumble.calibrations.methods.vibration.table import VibrationTable, best_point
from tumble.calibrations.tracing.noise import Whitening
from tumble.calibrations.tracing.quantified import Quantified, slices, tangent
from tumble.calibrations.tracing.trace import Found, Trace
from tumble.messages import Message

_SEEN: Final = 1e-3
"""Directions of the coefficients weaker than this, in parts of the strongest, are not seen by any row."""
_SHARED: Final = 0.05
"""A coefficient, or a sum, that shares more than this with such directions is not identifiable.

A drive that is not quite along an axis shares a little with the coefficients across: what it takes of them is their
part of a motion that small.
"""
_ROUNDS: Final = 25
_HALVINGS: Final = 8
_STEP: Final = 1e-4
"""Relative step for the derivative of an effect with its value."""
_SETTLED: Final = 1e-9


@dataclass(frozen=True, kw_only=True)
class VibrationFit(Quantified):
    """Coefficients beside those of what was found."""

    theta: FloatArray
    """K_ii … K_ip in µg/g², then the rest outputs in µg."""
    parameter_covariance: FloatArray
    """Of K_ii … K_ip, shape (5, 5)."""
    directions: FloatArray
    """Orthonormal directions of K_ii … K_ip that no row sees, shape (n, 5)."""
    degrees_of_freedom: int
    inverse: FloatArray
    """From errors of the rows to errors of K_ii … K_ip, shape (5, rows)."""
    squares: float
    """Weighted, whitened sum of squared residuals."""
    drawn_ug: FloatArray
    """What is known of what is noise to a fit, structure without a name above all, shape (rows,)."""

    @property
    def coefficients_ug_g2(self) -> FloatArray:
        """K_ii … K_ip, shape (5,), those that are not identifiable too."""
        return self.theta[:COEFFICIENTS]

    def told(self, sum_of: Sequence[int]) -> bool:
        """Whether the rows tell a sum of coefficients."""
        share = self.directions[:, list(sum_of)].sum(axis=1) / np.sqrt(len(sum_of))
        return bool(np.linalg.norm(share) < _SHARED)

    @cached_property
    def sums(self) -> tuple[tuple[int, ...], ...]:
        """Sums of coefficients that are told where none of them is, the shortest ones."""
        unseen = {place for place in range(COEFFICIENTS) if not self.told((place,))}
        found: list[tuple[int, ...]] = []
        for each in SUMS:
            if unseen.issuperset(each) and self.told(each) and not any(set(known) <= set(each) for known in found):
                found.append(each)
        return tuple(found)

    def parameters(self) -> dict[str, Parameter]:
        """Every coefficient with its uncertainty, or why there is none; then the sums that are told in their place."""
        every = {NAMES[place]: self._parameter((place,)) for place in range(COEFFICIENTS)}
        return every | {name_of(each): self._parameter(each) for each in self.sums}

    def _parameter(self, sum_of: tuple[int, ...]) -> Parameter:
        chosen = list(sum_of)
        value = float(self.coefficients_ug_g2[chosen].sum())
        uncertainty = float(np.sqrt(self.parameter_covariance[np.ix_(chosen, chosen)].sum()))
        half = coverage_factor(self.degrees_of_freedom) * uncertainty
        whole = Parameter(
            name=name_of(sum_of),
            unit=UNIT,
            value=value,
            standard_uncertainty=uncertainty,
            type_a=uncertainty,
            degrees_of_freedom=float(self.degrees_of_freedom),
            interval_95=(value - half, value + half),
        )
        return whole if self.told(sum_of) else whole.withheld(self._reason(sum_of[0]))

    def _reason(self, place: int) -> str:
        holding = next((each for each in self.sums if place in each), None)
        if holding is not None:
            return Message("these dwells tell only the sum {name}", name=name_of(holding))
        return Message("these dwells do not tell it: its product does not vary by itself")


def fit_vibration(table: VibrationTable, trace: Trace) -> VibrationFit:
    """Fit the declared model with what was found, by Gauss and Newton where an effect is not linear."""
    table = table.with_components(trace.components)
    whitening = table.memory.whitening(trace.noise)
    problem = _Problem(table, trace.found, whitening)
    linear = table.fit(trace.forms, trace.noise).theta
    theta = problem.solved(problem.start(linear))
    return _stated(problem, trace, theta)


class _Problem:
    """Rows as a function of the declared parameters and of one coefficient for each column of what was found."""

    def __init__(self, table: VibrationTable, found: Sequence[Found], whitening: Whitening) -> None:
        self.table, self.found, self.whiten = table, found, whitening
        self.size = table.model.parameters
        self.places = slices([item.form.columns.shape[1] for item in found])
        self.root = np.sqrt(table.weights)

    @property
    def curved(self) -> Iterator[tuple[Curved, int]]:
        """Effects that are not linear, with the place of their value."""
        for item, place in zip(self.found, self.places, strict=True):
            if (curved := CURVED.get(str(item.effect.name))) is not None:
                yield curved, self.size + place.start

    def start(self, theta: FloatArray) -> FloatArray:
        """Parameters of the linear fit, with each value that is not linear where it is best beside the others."""
        theta = theta.copy()
        for curved, at in self.curved:
            others = [
                item.form.columns
                for item, place in zip(self.found, self.places, strict=True)
                if self.size + place.start != at
            ]
            if (point := best_point(self.table, curved, others)) is not None:
                theta[at], theta[:COEFFICIENTS] = point.value, point.coefficients
        return self.allowed(theta)

    def allowed(self, theta: FloatArray) -> FloatArray:
        """Parameters with values that mean something."""
        theta = theta.copy()
        for curved, place in self.curved:
            theta[place] = np.clip(theta[place], *curved.allowed)
        return theta

    def predicted(self, theta: FloatArray) -> FloatArray:
        """Outputs, shape (rows,)."""
        output = self.table.declared @ theta[: self.size]
        for item, place in zip(self.found, self.places, strict=True):
            if str(item.effect.name) not in CURVED:
                output = output + item.form.columns @ theta[self.size :][place]
        for curved, at in self.curved:
            output = output + curved.shares(self.table.scene, float(theta[at])).added(theta[:COEFFICIENTS])
        return np.asarray(output)

    def jacobian(self, theta: FloatArray) -> FloatArray:
        """Its derivative, shape (rows, parameters)."""
        columns = np.column_stack([self.table.declared, *(item.form.columns for item in self.found)])
        for curved, at in self.curved:
            value, scene = float(theta[at]), self.table.scene
            columns[:, :COEFFICIENTS] += curved.shares(scene, value).matrix
            step = _STEP * max(abs(value), 1e-6)
            above, below = (
                curved.shares(scene, value + side * step).added(theta[:COEFFICIENTS]) for side in (1.0, -1.0)
            )
            columns[:, at] = (above - below) / (2.0 * step)
        return columns

    def white(self, columns: FloatArray) -> FloatArray:
        """Columns weighted and whitened."""
        return self.whiten(columns * (self.root if columns.ndim == 1 else self.root[:, None]))

    def misfit(self, theta: FloatArray) -> FloatArray:
        """What parameters leave, weighted and whitened."""
        return self.white(self.table.output - self.predicted(theta))

    def solved(self, theta: FloatArray) -> FloatArray:
        """The parameters that leave least, from some that are near."""
        left = self.misfit(theta)
        squares = float(left @ left)
        for _ in range(_ROUNDS):
            step = pseudo_inverse(self.white(self.jacobian(theta)))[0] @ left
            trial, remaining = self._halved(theta, step, squares)
            settled = squares - remaining < _SETTLED * squares
            if remaining <= squares:
                theta, squares = trial, remaining
                left = self.misfit(theta)
            if settled:
                break
        return theta

    def _halved(self, theta: FloatArray, step: FloatArray, squares: float) -> tuple[FloatArray, float]:
        """A step that leaves less, and what it leaves; the last one tried where none does."""
        for halving in range(_HALVINGS):
            trial = self.allowed(theta + step / 2.0**halving)
            left = self.misfit(trial)
            if (remaining := float(left @ left)) <= squares:
                break
        return trial, remaining


def _stated(problem: _Problem, trace: Trace, theta: FloatArray) -> VibrationFit:
    table, size = problem.table, problem.size
    changes = [
        tangent(table.scene, item, theta[size:][place])
        for item, place in zip(problem.found, problem.places, strict=True)
    ]
    jacobian = np.column_stack([problem.jacobian(theta), *(change for change in changes if change is not None)])
    seen = problem.white(jacobian)
    inverse, _ = pseudo_inverse(seen)
    freedom = max(table.rows - int(np.linalg.matrix_rank(seen / _lengths(seen))), 1)
    left = problem.misfit(theta)
    variance = float(left @ left) / freedom
    together = variance * inverse @ inverse.T
    misfit = table.output - problem.predicted(theta)
    residual = np.asarray(problem.whiten(left) / problem.root)
    numbers = iter(range(len(theta) - size, jacobian.shape[1] - size))
    return VibrationFit(
        found=trace.found,
        columns=tuple(problem.places),
        scanned=tuple(None if change is None else next(numbers) for change in changes),
        coefficients=np.concatenate([theta[size:], np.zeros(jacobian.shape[1] - len(theta))]),
        covariance=together[size:, size:],
        residual=residual,
        dwell=float(np.sqrt(variance)),
        theta=theta[:size],
        parameter_covariance=together[:COEFFICIENTS, :COEFFICIENTS],
        directions=_unseen(table, seen),
        degrees_of_freedom=freedom,
        inverse=_from_rows(problem, inverse),
        squares=float(left @ left),
        drawn_ug=misfit - residual,
    )


def _from_rows(problem: _Problem, inverse: FloatArray) -> FloatArray:
    """From errors of the rows, neither weighted nor whitened, to errors of K_ii … K_ip; the whitening is symmetric."""
    return np.asarray(problem.whiten(inverse[:COEFFICIENTS].T).T * problem.root)


def _lengths(columns: FloatArray) -> FloatArray:
    length = np.linalg.norm(columns, axis=0)
    return np.where(length > 0.0, length, 1.0)


def _unseen(table: VibrationTable, seen: FloatArray) -> FloatArray:
    """Directions of K_ii … K_ip that no row sees, shape (n, 5): all five in the scale of the drive, so that what a
    rounded phase leaves of a product is no sight of it.
    """
    scale = _lengths(seen)
    scale[:COEFFICIENTS] = max(float(np.linalg.norm(table.scene.power_g2 * np.sqrt(table.weights))), 1e-12)
    _, values, vectors = np.linalg.svd(seen / scale, full_matrices=True)
    rank = int(np.sum(values > _SEEN * values[0]))
    unseen = vectors[rank:, :COEFFICIENTS]
    if not len(unseen):
        return np.asarray(unseen)
    _, sizes, right = np.linalg.svd(unseen, full_matrices=False)
    return np.asarray(right[sizes > _SEEN] * sizes[sizes > _SEEN, None])


def points_of(fit: VibrationFit) -> dict[str, Point]:
    """Where effects that were found and are not linear came to lie."""
    return {
        str(item.effect.name): Point(value=float(fit.coefficients[place.start]), coefficients=fit.coefficients_ug_g2)
        for item, place in zip(fit.found, fit.columns, strict=True)
        if str(item.effect.name) in CURVED
    }
