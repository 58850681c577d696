"""The joint analysis of one observation table: from rows to parameters with their uncertainty."""

from collections.abc import Mapping

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.budget import BudgetLine, Source, contributions, effective_freedom, scatter_line
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.gravity import per_acceleration
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.propagation import TRIALS, MonteCarlo
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty, sources
from tumble.calibrations.methods.dividing_head.fit import Alpha0Profile, covariance
from tumble.calibrations.methods.dividing_head.flips import flip_closure
from tumble.calibrations.methods.dividing_head.held_out import held_out_rms
from tumble.calibrations.methods.dividing_head.identifiability import Identification, identify
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P, Joint, fit_jointly
from tumble.calibrations.methods.dividing_head.model import ALPHA0, PARAMETERS, UNITS
from tumble.calibrations.methods.dividing_head.montecarlo import monte_carlo
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.published import published_method
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.messages import Message


@one_blas_thread
def analyse(observations: Observations, stand: StandUncertainty | None = None, trials: int = TRIALS) -> Calibration:
    """Fit all rows jointly and say what each parameter is, how well it is known and on what that rests.

    Parameters
    ----------
    observations
        Rows with a voltage.
    stand
        What the stand adds (type B); None where nothing is known of it.
    trials
        Trials of the Monte Carlo check; with 0 there is none.

    Raises
    ------
    ValueError
        No voltage, or no usable row: one sentence.
    """
    if not len(observations):
        raise ValueError(Message("{source}: no usable row; every one was set aside", source=observations.source))
    return assess(fit_jointly(observations), stand or StandUncertainty(), trials)


@one_blas_thread
def assess(
    fitted: Joint, stand: StandUncertainty, trials: int = TRIALS, further: tuple[Source, ...] = ()
) -> Calibration:
    """What a joint fit says of the parameters; further columns in it, and further sources, are taken into account."""
    verdicts = identify(fitted)
    listed = (*sources(fitted.scene, stand), *further)
    type_a = covariance(fitted.compressed, fitted.fit, fitted.profile, fitted.noise.used_v**2)
    type_b = {source.name: _spread(fitted, source) for source in listed}
    combined = type_a + sum(type_b.values(), start=np.zeros_like(type_a))
    parameters = {
        name: _parameter(index, name, verdicts[name], fitted, type_a, combined) for index, name in enumerate(PARAMETERS)
    }
    stated = [name for name in PARAMETERS if parameters[name].value is not None]
    return Calibration(
        observations=fitted.observations,
        parameters=parameters,
        correlation=_correlation(combined, parameters),
        noise=fitted.noise,
        residual_v=fitted.residual_v,
        weights=fitted.weights,
        residual_rms_v=float(np.sqrt(np.mean(fitted.residual_v**2))),
        held_out_rms_v=held_out_rms(fitted.observations, fitted.basis, fitted.weights, fitted.fit.alpha0_fitted),
        lack_of_fit_p=fitted.lack.p_value,
        closure=flip_closure(fitted.observations, fitted.observations.output_v - fitted.residual_v, fitted.error),
        published=published_method(fitted.observations),
        budget=_budget(fitted, type_a, listed, type_b, stated),
        monte_carlo=_simulate(fitted, listed, trials).by_name(PARAMETERS, stated) if trials else {},
        per_acceleration=per_acceleration(parameters, stand.gravity) if stand.gravity else {},
        warnings=(*fitted.observations.warnings, *_doubts(fitted), *filter(None, [stand.left_out])),
        stand_record=stand.record,
    )


def _doubts(fitted: Joint) -> tuple[str, ...]:
    """What the test of lack of fit says beyond its p: that the model fails, or that repeats differ as a whole."""
    p_value, source = fitted.lack.p_value, fitted.observations.source
    if misfit := lack_of_fit_warning(source, p_value):
        return (misfit,)
    if p_value is not None and p_value > 1 - LACK_OF_FIT_P / 10:
        return (
            Message(
                "{source}: repeats scatter far more than the poses about the model (p = {p_value:.4f}): something "
                "changes between the realisations, and uncertainties that take rows as independent are too small",
                source=source,
                p_value=p_value,
            ),
        )
    return ()


def lack_of_fit_warning(source: str, p_value: float | None) -> str:
    """That the declared model fails; empty where it does not, or where there was no test."""
    if p_value is None or p_value >= LACK_OF_FIT_P:
        return ""
    return Message(
        "{source}: the declared model does not describe the poses (lack of fit, p = {p_value:.2g}); "
        "uncertainties rest on that disagreement",
        source=source,
        p_value=p_value,
    )


def _spread(fitted: Joint, source: Source) -> FloatArray:
    """Covariance of the parameters from one source of type B (GUM 5.1.2, with the errors of the rows as inputs)."""
    shift = fitted.fit.inverse @ source.turned(fitted.compressed.rotation)
    return np.asarray(shift @ shift.T)


def _parameter(
    index: int, name: str, verdict: Identification, fitted: Joint, type_a: FloatArray, combined: FloatArray
) -> Parameter:
    if not verdict.identifiable:
        return Parameter(
            name=name,
            unit=UNITS[name],
            value=None,
            standard_uncertainty=None,
            type_a=None,
            degrees_of_freedom=None,
            interval_95=None,
            reason=verdict.reason,
            settled_by=verdict.settled_by,
        )
    value, u_a, u = (
        float(fitted.fit.theta[index]),
        float(np.sqrt(type_a[index, index])),
        float(np.sqrt(combined[index, index])),
    )
    u_b = np.sqrt(max(u**2 - u_a**2, 0.0))
    freedom = effective_freedom([(u_a, fitted.noise.used_degrees_of_freedom), (u_b, np.inf)])
    return Parameter(
        name=name,
        unit=UNITS[name],
        value=value,
        standard_uncertainty=u,
        type_a=u_a,
        degrees_of_freedom=freedom,
        interval_95=_interval(index, value, u, u_a, freedom, fitted.profile),
        given=verdict.given,
        rests_on=verdict.rests_on,
        remark=verdict.remark,
        settled_by=verdict.settled_by,
    )


def _interval(
    index: int, value: float, u: float, u_a: float, freedom: float, profile: Alpha0Profile
) -> tuple[float, float]:
    """Value and expanded uncertainty; for alpha0 the profile's own interval, widened by what the stand adds."""
    k = coverage_factor(freedom)
    if index != ALPHA0:
        return value - k * u, value + k * u
    widening = u / u_a if u_a > 0 else 1.0
    low, high = profile.interval_deg
    return value - (value - low) * widening, value + (high - value) * widening


def _correlation(matrix: FloatArray, parameters: Mapping[str, Parameter]) -> FloatArray:
    known = np.array([parameter.value is not None for parameter in parameters.values()])
    matrix = matrix[: len(known), : len(known)]
    deviation = np.sqrt(np.where(known & (np.diag(matrix) > 0), np.diag(matrix), np.nan))
    return np.asarray(matrix / np.outer(deviation, deviation))


def _budget(
    fitted: Joint, type_a: FloatArray, listed: tuple[Source, ...], type_b: Mapping[str, FloatArray], stated: list[str]
) -> tuple[BudgetLine, ...]:
    noise = fitted.noise
    scatter = scatter_line(noise.used_v, noise.used_degrees_of_freedom, contributions(type_a, PARAMETERS, stated))
    further = (source.line(contributions(type_b[source.name], PARAMETERS, stated)) for source in listed)
    return (scatter, *further)


def _simulate(fitted: Joint, listed: tuple[Source, ...], trials: int) -> MonteCarlo:
    rotation = fitted.compressed.rotation
    errors = np.column_stack([np.zeros((rotation.shape[1], 1)), *(source.turned(rotation) for source in listed)])
    nodes = fitted.profile.nodes_deg(float(fitted.fit.theta[ALPHA0]))
    return monte_carlo(fitted.compressed, fitted.fit, nodes, fitted.noise, errors, trials)
