"""The course that several units share, each with a size of its own.

Unit j shows aⱼ f over the knots, f a Gaussian process of which each kernel and variance is tried (as in
`tracing.components`), the aⱼ with a mean of 1. Given the sizes, f follows from all units by least squares with that
prior; given f, each size does; both are repeated until they stand (expectation-conditional maximisation, Meng and Rubin
1993).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.adopted.curve import Curve
from tumble.calibrations.adopted.knots import Knots
from tumble.calibrations.adopted.seen import Seen
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.tracing.effect import Expected

_ROUNDS: Final = 60
_STANDS: Final = 1e-6
"""Sizes that change by less than this stand."""
_RATIOS: Final = np.logspace(-4.0, 4.0, 81)
"""Variances that are tried, in those that the runs see as clearly as their noise."""
_ONE_SIGN: Final = 0.3
"""A mean size below this part of the root mean square size is none that units have in common."""
_SURE: Final = 0.02
"""No unit is known closer than this part before it is measured."""
_NORMAL: Final = coverage_factor(float("inf"))


@dataclass(frozen=True, kw_only=True)
class Size:
    """How large the effect is in one unit, in those of the mean of all."""

    value: float
    standard_uncertainty: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Shared:
    """What units say together of a course."""

    curve: Curve
    kernel: str
    """Kind of course and its length in ranges of the variable."""
    gain: float
    """By how much -2 ln L falls with it."""
    sizes: tuple[Size, ...]

    @property
    def in_common(self) -> bool:
        """Whether the sizes have a mean that is worth the name."""
        values = np.array([each.value for each in self.sizes])
        return bool(np.mean(values) > _ONE_SIGN * np.sqrt(np.mean(values**2)))

    @property
    def spread(self) -> float | None:
        """Standard deviation between units beyond what their measurements scatter by; None for one unit."""
        if len(self.sizes) < 2:
            return None
        values = np.array([each.value for each in self.sizes])
        scatter = np.mean([each.standard_uncertainty**2 for each in self.sizes])
        return float(np.sqrt(max(np.var(values, ddof=1) - scatter, 0.0)))


def expected(spread: float | None, units: int) -> Expected | None:
    """What is known of the next unit: the mean of 1, and what a spread from so few units says (Student's t)."""
    if spread is None:
        return None
    few = coverage_factor(units - 1) / _NORMAL * np.sqrt(1.0 + 1.0 / units)
    return Expected(value=1.0, standard_deviation=max(float(spread * few), _SURE))


def shared(runs: Sequence[Seen], knots: Knots) -> Shared:
    """What runs, each of one unit, say together of a course over the knots."""
    strongest = max((_course((run,), np.ones(1), knots) for run in runs), key=lambda found: found.gain)
    sizes = np.array([strongest.size_in(run) for run in runs]) if len(runs) > 1 else np.ones(1)
    sizes = sizes / _scale(sizes)
    for _ in range(_ROUNDS):
        found = _course(runs, sizes, knots)
        again = np.array([found.size_in(run) for run in runs])
        again = again / _scale(again)
        moved, sizes = float(np.max(np.abs(again - sizes))), again
        if moved < _STANDS or len(runs) == 1:
            break
    found = _course(runs, sizes, knots)
    curve = Curve(knots=knots, values=found.values, covariance=found.covariance)
    return Shared(
        curve=curve,
        kernel=found.kernel,
        gain=found.gain,
        sizes=tuple(
            Size(value=float(size), standard_uncertainty=run.along(curve.values)[1])
            for size, run in zip(sizes, runs, strict=True)
        ),
    )


def _scale(sizes: FloatArray) -> float:
    """What makes the mean 1; where there is none to speak of, the mean square."""
    mean, root = float(np.mean(sizes)), float(np.sqrt(np.mean(sizes**2)))
    return mean if abs(mean) > _ONE_SIGN * root else max(root, 1e-300)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Course:
    """The best course for given sizes."""

    values: FloatArray
    covariance: FloatArray
    kernel: str
    gain: float

    def size_in(self, run: Seen) -> float:
        """Size in a run, what is not known of the course counted."""
        shown = run.design @ self.values
        square = float(shown @ shown) + float(np.sum((run.design @ self.covariance) * run.design))
        return float(shown @ run.output) / max(square, 1e-300)


def _course(runs: Sequence[Seen], sizes: FloatArray, knots: Knots) -> _Course:
    gram = sum((size**2 * run.design.T @ run.design for size, run in zip(sizes, runs, strict=True)))
    shown = sum((size * run.design.T @ run.output for size, run in zip(sizes, runs, strict=True)))
    tried = (_posterior(word, root, np.asarray(gram), np.asarray(shown)) for word, root in knots.courses)
    return max(tried, key=lambda found: found.gain)


def _posterior(word: str, root: FloatArray, gram: FloatArray, shown: FloatArray) -> _Course:
    """Mean and covariance of a course with a kernel, in the variance that is likeliest."""
    information, vectors = np.linalg.eigh(root.T @ gram @ root)
    information = np.maximum(information, 0.0)
    along = vectors.T @ (root.T @ shown)
    ratios = _RATIOS[:, None] / max(float(information[-1]), 1e-300)
    known = 1.0 + ratios * information
    gains = np.sum(ratios * along**2 / known - np.log(known), axis=1)
    best = int(np.argmax(gains))
    variance = ratios[best] / known[best]
    directions = root @ vectors
    return _Course(
        values=np.asarray(directions @ (variance * along)),
        covariance=np.asarray((directions * variance) @ directions.T),
        kernel=word,
        gain=float(gains[best]),
    )
