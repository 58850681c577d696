"""Propagation of distributions (JCGM 101): the check on the budget."""

from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.dividing_head.fit import JointFit
from tumble.calibrations.methods.dividing_head.joint import Noise
from tumble.calibrations.methods.dividing_head.model import coefficients, design, further_terms, parameter_vector

TRIALS = 20_000
SEED = 20081
_DRAWN_EACH = 1000
"""Up to so many errors are drawn one by one; 20,000 trials of a million would be 160 gigabytes."""


@dataclass(frozen=True, kw_only=True)
class MonteCarlo:
    """What repeated simulated calibrations of the fitted unit give."""

    trials: int
    standard_uncertainty: FloatArray
    """Root mean square deviation of each parameter from the fitted value, bias included, shape (6,)."""
    interval_95: FloatArray
    """Probabilistically symmetric 95% interval (JCGM 101, 7.7), shape (6, 2)."""


def monte_carlo(
    compressed: Compressed,
    fit: JointFit,
    nodes_deg: FloatArray,
    scatter: Noise,
    errors_v: FloatArray,
    trials: int,
) -> MonteCarlo:
    """Simulate the rows anew and refit the full nonlinear model to each.

    `nodes_deg` are values of alpha0 that span what it can be; `scatter` is that of a row of weight 1, with few degrees
    of freedom a Student distribution (JCGM 101, 6.4.9); `errors_v`, shape (10 + terms, n), are the independent errors
    of type B as they show in the rotated voltages, one standard uncertainty each. Work is done on those, where white
    noise stays white. Many errors are drawn as their sum is distributed: normal, with their covariance.
    """
    generator = np.random.default_rng(SEED)
    effect = errors_v if errors_v.shape[1] <= _DRAWN_EACH else _root(errors_v @ errors_v.T)
    centre = compressed.r @ coefficients(fit.theta)
    freedom = max(scatter.used_degrees_of_freedom, 1)
    ruler_v = scatter.used_v * np.sqrt(freedom / generator.chisquare(freedom, size=(trials, 1)))
    noise = generator.normal(size=(trials, len(centre))) * ruler_v
    shared = generator.normal(size=(trials, effect.shape[1])) @ effect.T
    theta = _refit(compressed, fit, np.unique(nodes_deg), centre + noise + shared)
    low, high = np.quantile(theta, [0.025, 0.975], axis=0)
    return MonteCarlo(
        trials=trials,
        standard_uncertainty=np.sqrt(np.mean((theta - fit.theta) ** 2, axis=0)),
        interval_95=np.column_stack([low, high]),
    )


def _root(covariance: FloatArray) -> FloatArray:
    """Independent columns that give a covariance."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))


def _refit(compressed: Compressed, fit: JointFit, nodes_deg: FloatArray, z: FloatArray) -> FloatArray:
    """Least squares for every row of `z`: the alpha0 that leaves least, then the linear parameters at it."""
    if not fit.alpha0_fitted:
        return np.asarray(fit.theta + (z - compressed.r @ coefficients(fit.theta)) @ fit.inverse.T)
    alpha0_deg = _best_alpha0(compressed, nodes_deg, z)
    inverse, _ = pseudo_inverse(compressed.r @ design(alpha0_deg, further_terms(compressed)))
    return parameter_vector(np.einsum("tij,tj->ti", inverse, z), alpha0_deg)


def _best_alpha0(compressed: Compressed, nodes_deg: FloatArray, z: FloatArray) -> FloatArray:
    """Where on the nodes the model captures most of each row of `z`, refined by a parabola."""
    matrices = compressed.r @ design(nodes_deg, further_terms(compressed))
    captured = np.stack(
        [np.sum((z @ m @ i) * z, axis=1) for m, i in zip(matrices, pseudo_inverse(matrices)[0], strict=True)]
    )
    top = np.clip(np.argmax(captured, axis=0), 1, len(nodes_deg) - 2)
    trial = np.arange(len(z))
    before, at, after = (captured[top + shift, trial] for shift in (-1, 0, 1))
    left, right = nodes_deg[top] - nodes_deg[top - 1], nodes_deg[top + 1] - nodes_deg[top]
    turn = left**2 * (at - after) - right**2 * (at - before)
    return np.asarray(nodes_deg[top] - 0.5 * turn / (left * (at - after) + right * (at - before)))
