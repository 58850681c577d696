"""The joint fit of a table: gross errors out, weights from the repeats, the noise that the uncertainties rest on."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.adequacy import LackOfFit, lack_of_fit
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.compression import Compressed, Whiten, compress, unchanged
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.repeats import PureError, pure_error
from tumble.calibrations.core.resolution import as_written
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.fit import (
    Alpha0Profile,
    JointFit,
    alpha0_profile,
    fit_given_alpha0,
    joint_fit,
)
from tumble.calibrations.methods.dividing_head.gross import disturbed_realisations, gross_errors
from tumble.calibrations.methods.dividing_head.model import (
    ALPHA0,
    PARAMETERS,
    basis,
    coefficients,
    coefficients_jacobian,
)
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import pose_groups
from tumble.calibrations.methods.dividing_head.weights import dwell_weights
from tumble.messages import Message

LACK_OF_FIT_P = 0.01
"""Below this the poses disagree with the model by more than the repeats explain, and their scatter is the ruler."""


ROUNDING_V = 1e-12
"""Scatter below this is rounding: no voltmeter resolves a picovolt."""


@dataclass(frozen=True, kw_only=True)
class Noise:
    """Scatter of one dwell mean."""

    pure_error_v: float | None
    """Between repeats; None where there are none."""
    degrees_of_freedom: int
    used_v: float
    """What the uncertainties rest on, for a row of weight 1."""
    used_degrees_of_freedom: int
    basis: Message
    """Where `used_v` comes from, in words."""


@dataclass(frozen=True, kw_only=True)
class Joint:
    """The rows that were used and their fit, from which everything else follows."""

    observations: Observations
    basis: FloatArray
    weights: FloatArray
    compressed: Compressed
    fit: JointFit
    profile: Alpha0Profile
    error: PureError
    lack: LackOfFit
    noise: Noise
    residual_v: FloatArray
    """Measured minus fitted, and minus what is known of autocorrelated noise, shape (rows,), in volts."""

    @property
    def slope_v_per_deg(self) -> FloatArray:
        """Change of the output with the head angle at each row, shape (rows,)."""
        return np.asarray(self.basis @ coefficients_jacobian(self.fit.theta)[:, ALPHA0])

    @property
    def scene(self) -> Scene:
        """The rows as effects see them once all that was fitted is known."""
        return Scene(
            observations=self.observations,
            alpha0_deg=float(self.fit.theta[ALPHA0]),
            output_v=np.asarray(self.basis @ coefficients(self.fit.theta)),
            slope_v_per_deg=self.slope_v_per_deg,
            response_v_per_g=self.fit.theta[1:4],
            product_v_per_g2=float(self.fit.theta[4]),
        )


@one_blas_thread
def fit_jointly(observations: Observations) -> Joint:
    """Fit the declared model to all rows but gross errors; alpha0 is held at 0 where it is not identifiable."""
    rejected = gross_errors(observations, basis(observations), pose_groups(observations), len(PARAMETERS))
    return fit_without(observations, rejected)


def fit_without(observations: Observations, rejected: tuple[SetAside, ...]) -> Joint:
    """Fit the declared model to all rows but those that are to be set aside."""
    if rejected:
        disturbed = disturbed_realisations(observations, rejected)
        observations = replace(observations.without(rejected), warnings=(*observations.warnings, *disturbed))
    groups = pose_groups(observations)
    functions = basis(observations)
    even = np.ones(len(observations))
    first = joint_fit(compress(functions, observations.output_v, even))
    weights = dwell_weights(observations, observations.output_v - functions @ coefficients(first.theta), groups)
    return fit_rows(observations, functions, weights)


def fit_rows(
    observations: Observations,
    functions: FloatArray,
    weights: FloatArray,
    whiten: Whiten = unchanged,
    known: Sequence[tuple[int, float, float]] = (),
) -> Joint:
    """Fit rows that are taken as they are.

    Parameters
    ----------
    observations
        Rows without gross errors.
    functions
        The ten functions of the declared model and any further columns, shape (rows, 10 + terms).
    weights
        Relative weight of each row, shape (rows,).
    whiten
        What makes weighted rows independent of each other.
    known
        What is known of coefficients beforehand, see `Compressed.knowing`.
    """
    groups = pose_groups(observations)
    compressed = compress(functions, observations.output_v, weights, whiten)
    for place, value, weight_v in known:
        compressed = compressed.knowing(place, value, weight_v)
    fit = joint_fit(compressed)
    residual, error, lack, noise = _judge(observations, functions, weights, groups, fit, whiten)
    profile = alpha0_profile(compressed, fit, noise.used_v**2, coverage_factor(noise.used_degrees_of_freedom))
    if not profile.identifiable:
        fit = fit_given_alpha0(compressed, 0.0)
        residual, error, lack, noise = _judge(observations, functions, weights, groups, fit, whiten)
    return Joint(
        observations=observations,
        basis=functions,
        weights=weights,
        compressed=compressed,
        fit=fit,
        profile=profile,
        error=error,
        lack=lack,
        noise=noise,
        residual_v=residual,
    )


def _judge(
    observations: Observations,
    functions: FloatArray,
    weights: FloatArray,
    groups: NDArray[np.int64],
    fit: JointFit,
    whiten: Whiten,
) -> tuple[FloatArray, PureError, LackOfFit, Noise]:
    root = np.sqrt(weights)
    misfit = observations.output_v - functions @ coefficients(fit.theta)
    residual = np.asarray(whiten(whiten(misfit * root)) / root)  # best linear unbiased prediction (Henderson 1975)
    error = pure_error(residual, groups, weights)
    lack = lack_of_fit(fit.squares_v2, len(observations), fit.fitted, error)
    if lack.p_value is not None and lack.p_value < LACK_OF_FIT_P and as_written(functions, observations.output_v):
        lack = replace(lack, p_value=None)  # repeats that are rounded alike show no scatter to test against
    return residual, error, lack, _noise(fit, len(observations), error, lack)


def _rests_on_poses(error: PureError, lack: LackOfFit) -> bool:
    """Whether the poses scatter by more than their repeats say, or their repeats, being rounded alike, say nothing."""
    if lack.p_value is None:
        return error.degrees_of_freedom > 0 and lack.degrees_of_freedom > 0
    return lack.p_value < LACK_OF_FIT_P


def _noise(fit: JointFit, rows: int, error: PureError, lack: LackOfFit) -> Noise:
    """The ruler: all scatter about the fit, or that of the poses."""
    freedom = rows - fit.fitted
    if _rests_on_poses(error, lack):
        used, used_freedom, basis_text = (
            lack.variance,
            lack.degrees_of_freedom,
            Message("scatter of the poses about the model"),
        )
    else:
        used, used_freedom = fit.squares_v2 / max(freedom, 1), freedom
        basis_text = Message("scatter about the fit, repeats included")
    return Noise(
        pure_error_v=error.standard_deviation if error.degrees_of_freedom else None,
        degrees_of_freedom=error.degrees_of_freedom,
        used_v=max(float(np.sqrt(used)), ROUNDING_V),
        used_degrees_of_freedom=max(used_freedom, 0),
        basis=basis_text,
    )
