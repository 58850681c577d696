"""Propagation of distributions (JCGM 101): the check on the budget."""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.propagation import MonteCarlo, drawn_errors_v, summarised
from tumble.calibrations.core.solutions import pseudo_inverse
from tumble.calibrations.methods.dividing_head.fit import JointFit
from tumble.calibrations.methods.dividing_head.joint import Noise
from tumble.calibrations.methods.dividing_head.model import coefficients, design, further_terms, parameter_vector


def monte_carlo(
    compressed: Compressed,
    fit: JointFit,
    nodes_deg: FloatArray,
    scatter: Noise,
    errors_v: FloatArray,
    trials: int,
) -> MonteCarlo:
    """Simulate the rows anew and refit the full nonlinear model to each.

    `nodes_deg` are values of alpha0 that span what it can be; `scatter` is that of a row of weight 1; `errors_v`, shape
    (10 + terms, n), are the independent errors of type B as they show in the rotated voltages, one standard uncertainty
    each. Work is done on those, where white noise stays white.
    """
    errors = drawn_errors_v(scatter.used_v, scatter.used_degrees_of_freedom, errors_v, trials)
    centre = compressed.r @ coefficients(fit.theta)
    return summarised(_refit(compressed, fit, np.unique(nodes_deg), centre + errors), fit.theta)


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
