"""Structure that a run shows along the axis of an adopted effect beyond that effect."""

import numpy as np

from tumble.calibrations.adopted.curve import Curve
from tumble.calibrations.adopted.seen import Seen
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.penalties import FALSE_ALARM, of_variance

_RATIOS = np.logspace(-3.0, 4.0, 57)
"""Variances that are tried, in those that a run sees as clearly as its noise."""


def left(run: Seen, curve: Curve, size: float) -> bool:
    """Whether a run shows a course beside so many times the curve; what is not known of the curve is no such course.

    A course of any kernel counts whose likelihood is higher by the penalty of all of them, `tracing.penalties`.
    """
    shown = run.design @ curve.values
    outside = np.eye(len(shown)) - np.outer(shown, shown) / max(float(shown @ shown), 1e-300)
    unknown = size * run.design @ curve.parts
    whiten = outside @ _whitening(unknown)
    misfit = whiten @ (run.output - size * shown)
    courses = curve.knots.courses
    gain = max(_gain(whiten @ (run.design @ root), misfit) for _, root in courses)
    return gain > of_variance(FALSE_ALARM / len(courses))


def _whitening(unknown: FloatArray) -> FloatArray:
    """What makes noise of variance 1 white that has these columns more, each with a coefficient of variance 1."""
    vectors, sizes, _ = np.linalg.svd(unknown, full_matrices=True)
    shrink = np.ones(len(vectors))
    shrink[: len(sizes)] = 1.0 / np.sqrt(1.0 + sizes**2)
    return np.asarray((vectors * shrink) @ vectors.T)


def _gain(columns: FloatArray, misfit: FloatArray) -> float:
    """By how much -2 ln L falls where the coefficients of columns have a variance."""
    vectors, sizes, _ = np.linalg.svd(columns, full_matrices=False)
    information, along = sizes**2, vectors.T @ misfit
    ratios = _RATIOS[:, None] / max(float(information[0]), 1e-300)
    known = 1.0 + ratios * information
    return float(np.max(np.sum(ratios * information * along**2 / known - np.log(known), axis=1), initial=0.0))
